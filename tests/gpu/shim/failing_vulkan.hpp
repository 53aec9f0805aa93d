// A Vulkan loader in front of the system's, for EYERAY_VULKAN_LOADER: one chosen call fails without reaching
// the driver. Calls are counted, and also the objects that were made and not destroyed.
//
// EYERAY_FAILING_CALL="vkWaitForFences 3 -4" chooses the call in a separate process: the third call returns
// −4. If that is 1000 instead, the call prints a line on standard error and never returns.
// EYERAY_NO_GRAPHICS=1 hides that queues can draw.
#pragma once

constexpr int never_returns = 1000;

extern "C" {
// From now on the `number`-th call of `function` returns `result`; no call does if `number` is 0. Sets all
// counts of calls to 0.
void fail_call(const char* function, int number, int result);
// The number of functions that return a result; the name of each, and the number of its calls.
int function_count();
const char* function_name(int function);
int calls(int function);
int objects_alive();
}
