// Every kind of shape: a row is all that has to be added outside the shape's own files. Its number is its kind in
// kind_of(primitive) and its place in the scene's order. A specialised kernel overrides the list with its scene's kinds.
#ifndef SHAPES
#define SHAPES(X) \
  X(sphere, 0u) \
  X(plane, 1u) \
  X(triangle, 2u) \
  X(box, 3u) \
  X(ellipsoid, 4u) \
  X(cylinder, 5u) \
  X(cone, 6u) \
  X(polygon, 7u) \
  X(parallelogram, 8u) \
  X(prism, 9u) \
  X(disk, 10u) \
  X(paraboloid, 11u) \
  X(hyperboloid, 12u) \
  X(capsule, 13u) \
  X(quadric, 14u) \
  X(torus, 15u) \
  X(superellipsoid, 16u) \
  X(bilinear, 17u) \
  X(implicit, 18u) \
  X(csg, 19u) \
  X(bezier, 20u)
#endif

// Those that take long: in a BVH that holds others too, rays wait with them for each other (bvh/traverse.glsl). A specialised kernel overrides this
// list too, and has the others of its BVHs as IMMEDIATE_SHAPES.
#ifndef DEFERRED_SHAPES
#define DEFERRED_SHAPES(X) \
  X(torus, 15u) \
  X(superellipsoid, 16u) \
  X(implicit, 18u) \
  X(csg, 19u) \
  X(bezier, 20u)
#endif

// Those that enclose a volume, where they have no `open`: what CSG objects are made of. Their rows stand before that of CSG object, which asks them.
// A specialised kernel overrides this list too, with those that its scene's CSG objects are made of.
#ifndef CLOSED_SHAPES
#define CLOSED_SHAPES(X) \
  X(sphere, 0u) \
  X(box, 3u) \
  X(ellipsoid, 4u) \
  X(cylinder, 5u) \
  X(cone, 6u) \
  X(prism, 9u) \
  X(paraboloid, 11u) \
  X(hyperboloid, 12u) \
  X(capsule, 13u) \
  X(quadric, 14u) \
  X(torus, 15u) \
  X(superellipsoid, 16u) \
  X(implicit, 18u)
#endif
