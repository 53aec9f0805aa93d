// A stack that lanes share: entry e is in row e / STACK_LANES on lane e % STACK_LANES, the top is entry 0, and below the last one all is
// TRAVERSAL_DONE. The file that includes this has STACK_LANES, STACK_ROWS, EACH_ROW, `lane` and `from_lane`.
#ifndef LANE_STACK_GLSL
#define LANE_STACK_GLSL

uint stack[STACK_ROWS];

// Pushes the values of the first `push` lanes, or drops `drop` entries.
void move_stack(uint push, uint drop, uint value) {
  uint turn = (lane + drop - push) & (STACK_LANES - 1u);
  bool from_before = lane < push;
  bool from_after = lane + drop >= STACK_LANES;
  uint turned[STACK_ROWS + 1];
  turned[STACK_ROWS] = TRAVERSAL_DONE;
  EACH_ROW turned[i] = from_lane(stack[i], turn);
  EACH_ROW {
    uint before = i > 0 ? turned[i > 0 ? i - 1 : 0] : value;
    stack[i] = from_before ? before : from_after ? turned[i + 1] : turned[i];
  }
}

#endif
