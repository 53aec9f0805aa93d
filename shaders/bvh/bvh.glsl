// A BVH: a ray's hits in it, and the stack of the waiting nodes.
// Boxes never decide a hit: they only leave out nodes without one. For that they are hit wherever rounding could let a shape in
// them be hit, and no hit is nearer than the ray's entry into the boxes around it (shapes/triangle.glsl).
#ifndef TREE_GLSL
#define TREE_GLSL
#include "geometry/ray.glsl"
#include "records.h"

SHADER_BEGIN

#ifndef SCENE_PRIMITIVES
#define TRAVERSAL_DONE 0xffffffffu   // below everything on the stack
#define LEAVE_INSTANCE 0xfffffffeu  // waits below the entries that an instance's BVH puts on the stack

// A ray as a BVH's boxes see it: it passes the plane at q at t = q · scale − near (− far, on the way out). Both are off by more
// than the error of any shape's t. The error grows with how far the ray's start and the BVH's boxes reach; and where there are
// instances, with how the maps into and out of them make errors grow.
struct BoxRay {
  vec3 scale;
  vec3 near;
  vec3 far;
  uvec3 turn;  // by axis: the bits by which a word of two planes is rotated so that coded_plane reads the plane of entry
};
#define TURN_FORWARD 7u
#define TURN_BACKWARD 23u  // where the ray runs towards lower coordinates


BoxRay box_ray(Ray ray, Bvh bvh) {
  vec3 offset = ray.o - bvh.origin;
  float reach = max_component(abs3(offset) + bvh.extent);
  vec3 slack = abs3(ray.inverse) * (bvh.slack * reach);
  BoxRay boxes;
  boxes.scale = bvh.step * ray.inverse;
  boxes.near = offset * ray.inverse + slack;
  boxes.far = offset * ray.inverse - slack;
  if (QUANTISED_NODES) {
    boxes.scale = boxes.scale * 65536.0f;
    boxes.near = boxes.near + boxes.scale;
    boxes.far = boxes.far + boxes.scale;
  }
  boxes.turn = uvec3(ray.inverse.x < 0.0f ? TURN_BACKWARD : TURN_FORWARD, ray.inverse.y < 0.0f ? TURN_BACKWARD : TURN_FORWARD,
                     ray.inverse.z < 0.0f ? TURN_BACKWARD : TURN_FORWARD);
  return boxes;
}

// The planes by which a ray enters and leaves a child's box, and the child's reference.
struct Child {
  vec3 near;
  vec3 far;
  uint refers_to;
};

float low_half(uint word) { return float(int(word & 0xffffu)); }

uint turned(uint word, uint by) { return (word << by) | (word >> (32u - by)); }

// A plane coded as q in bits 7 … 22, as 1 + q / 65536, the value of those bits in a float. On a CPU that is quicker than to convert q.
float coded_plane(uint word) { return uintBitsToFloat((word & 0x7fff80u) | 0x3f800000u); }

Child coded_child(uvec4 c, BoxRay ray) {
  uvec3 enters = uvec3(turned(c.x, ray.turn.x), turned(c.y, ray.turn.y), turned(c.z, ray.turn.z));
  Child child;
  child.near = vec3(coded_plane(enters.x), coded_plane(enters.y), coded_plane(enters.z));
  child.far = vec3(coded_plane(turned(enters.x, 16u)), coded_plane(turned(enters.y, 16u)), coded_plane(turned(enters.z, 16u)));
  child.refers_to = c.w;
  return child;
}

Child load_child(uint node, uint which, BoxRay ray) {
  Child child;
  if (QUANTISED_NODES) {
    child = coded_child(load_node(2u * node + which), ray);
  } else {
    uvec4 low_bits = load_node(4u * node + 2u * which);
    vec3 low = vec3(uintBitsToFloat(low_bits.x), uintBitsToFloat(low_bits.y), uintBitsToFloat(low_bits.z));
    uvec4 high_bits = load_node(4u * node + 2u * which + 1u);
    vec3 high = vec3(uintBitsToFloat(high_bits.x), uintBitsToFloat(high_bits.y), uintBitsToFloat(high_bits.z));
    child.near = vec3(ray.turn.x == TURN_FORWARD ? low.x : high.x, ray.turn.y == TURN_FORWARD ? low.y : high.y,
                      ray.turn.z == TURN_FORWARD ? low.z : high.z);
    child.far = vec3(ray.turn.x == TURN_FORWARD ? high.x : low.x, ray.turn.y == TURN_FORWARD ? high.y : low.y,
                     ray.turn.z == TURN_FORWARD ? high.z : low.z);
    child.refers_to = low_bits.w;
  }
  return child;
}

// Distances as the bits of floats. Signed integers order them as floats do where they are not negative. A negative distance, behind
// the ray, stays below all that are not. That is all the comparisons here need, and it costs a CPU less.
int lesser(int a, int b) { return b < a ? b : a; }
int greater(int a, int b) { return b > a ? b : a; }

int entry_of(Child child, BoxRay ray) {
  vec3 t = child.near * ray.scale - ray.near;
  return greater(greater(floatBitsToInt(t.x), floatBitsToInt(t.y)), greater(floatBitsToInt(t.z), 0));
}

int exit_of(Child child, BoxRay ray, int limit) {
  vec3 t = child.far * ray.scale - ray.far;
  return lesser(lesser(floatBitsToInt(t.x), floatBitsToInt(t.y)), lesser(floatBitsToInt(t.z), limit));
}

// The nodes that wait to be visited. A BVH is never deeper than STACK_SIZE, so nothing is lost.
struct Stack {
  uint entries[STACK_SIZE];
  uint size;
};

#if SHIFT_STACK
// The top is always entry 0: a push shifts all the others. With every index constant the entries stay in registers.
Stack empty_stack() {
  Stack stack;
  UNROLL for (int i = 0; i < STACK_SIZE; i++) stack.entries[i] = TRAVERSAL_DONE;
  stack.size = 0u;
  return stack;
}

uint top_of(Stack stack) { return stack.entries[0]; }

void move_stack(INOUT(Stack) stack, bool push, bool pop, uint value) {
  uint before = value;
  UNROLL for (int i = 0; i < STACK_SIZE; i++) {
    uint current = stack.entries[i];
    uint next = i + 1 < STACK_SIZE ? stack.entries[i + 1 < STACK_SIZE ? i + 1 : i] : TRAVERSAL_DONE;
    stack.entries[i] = push ? before : pop ? next : current;
    before = current;
  }
}
#else
Stack empty_stack() {
  Stack stack;
  stack.entries[0] = TRAVERSAL_DONE;
  stack.size = 0u;
  return stack;
}

uint top_of(Stack stack) { return stack.entries[stack.size]; }

void move_stack(INOUT(Stack) stack, bool push, bool pop, uint value) {
  if (push) {
    stack.size += 1u;
    stack.entries[stack.size] = value;
  } else if (pop && stack.size > 0u) {
    stack.size -= 1u;
  }
}
#endif

#endif

SHADER_END
#endif
