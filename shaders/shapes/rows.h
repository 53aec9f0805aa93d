// Every kind of shape: a row is all that has to be added outside the shape's own files. Its number is its kind in
// kind_of(primitive) and its position in the scene's order. Then its traits:
//   `deferred` takes long: in a BVH that holds others too, its intersection waits for other lanes (bvh/traverse.glsl); else immediate.
//   `closed`   encloses a volume, where it has no `open`: CSG objects are made of it, and its row stands before theirs; else no_leaf
#define SHAPE_ROWS(R, X) \
  R(X, sphere, 0u, immediate, closed) \
  R(X, plane, 1u, immediate, no_leaf) \
  R(X, triangle, 2u, immediate, no_leaf) \
  R(X, box, 3u, immediate, closed) \
  R(X, ellipsoid, 4u, immediate, closed) \
  R(X, cylinder, 5u, immediate, closed) \
  R(X, cone, 6u, immediate, closed) \
  R(X, polygon, 7u, immediate, no_leaf) \
  R(X, parallelogram, 8u, immediate, no_leaf) \
  R(X, prism, 9u, immediate, closed) \
  R(X, disk, 10u, immediate, no_leaf) \
  R(X, paraboloid, 11u, immediate, closed) \
  R(X, hyperboloid, 12u, immediate, closed) \
  R(X, capsule, 13u, immediate, closed) \
  R(X, quadric, 14u, immediate, closed) \
  R(X, torus, 15u, deferred, closed) \
  R(X, superellipsoid, 16u, deferred, closed) \
  R(X, bilinear, 17u, immediate, no_leaf) \
  R(X, implicit, 18u, deferred, closed) \
  R(X, csg, 19u, deferred, no_leaf) \
  R(X, bezier, 20u, deferred, no_leaf) \
  R(X, points, 21u, immediate, no_leaf)

// The lists of a specialised kernel hold its scene's kinds alone (executors/specialise.cpp); these hold all.
#ifndef SHAPES
#define SHAPES(X) SHAPE_ROWS(SHAPE_ROW, X)
#define SHAPE_ROW(X, name, number, time, volume) X(name, number)
#endif
#ifndef DEFERRED_SHAPES
#define DEFERRED_SHAPES(X) SHAPE_ROWS(ROW_BY_TIME, X)
#define ROW_BY_TIME(X, name, number, time, volume) ROW_OF_##time(X, name, number)
#define ROW_OF_deferred(X, name, number) X(name, number)
#define ROW_OF_immediate(X, name, number)
#endif
#ifndef CLOSED_SHAPES
#define CLOSED_SHAPES(X) SHAPE_ROWS(ROW_BY_VOLUME, X)
#define ROW_BY_VOLUME(X, name, number, time, volume) ROW_OF_##volume(X, name, number)
#define ROW_OF_closed(X, name, number) X(name, number)
#define ROW_OF_no_leaf(X, name, number)
#endif
#ifndef DEFERRED_LEAVES
#define DEFERRED_LEAVES(X) SHAPE_ROWS(DEFERRED_LEAF, X)
#define DEFERRED_LEAF(X, name, number, time, volume) DEFERRED_LEAF_##time##_##volume(X, name, number)
#define DEFERRED_LEAF_deferred_closed(X, name, number) X(name, number)
#define DEFERRED_LEAF_deferred_no_leaf(X, name, number)
#define DEFERRED_LEAF_immediate_closed(X, name, number)
#define DEFERRED_LEAF_immediate_no_leaf(X, name, number)
#endif
#ifndef IMMEDIATE_LEAVES
#define IMMEDIATE_LEAVES(X) SHAPE_ROWS(IMMEDIATE_LEAF, X)
#define IMMEDIATE_LEAF(X, name, number, time, volume) IMMEDIATE_LEAF_##time##_##volume(X, name, number)
#define IMMEDIATE_LEAF_immediate_closed(X, name, number) X(name, number)
#define IMMEDIATE_LEAF_immediate_no_leaf(X, name, number)
#define IMMEDIATE_LEAF_deferred_closed(X, name, number)
#define IMMEDIATE_LEAF_deferred_no_leaf(X, name, number)
#endif
