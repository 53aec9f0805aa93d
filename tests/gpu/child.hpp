#pragma once

#include <string_view>

#include "support.hpp"

namespace eyeray::engine::test {

// "list": names the devices on standard output; "endless": work that outlasts its time-out.
void child_work(std::string_view name);

// "failing calls": prints on standard output which calls of Vulkan end badly when they fail.
void fail_every_call();

}  // namespace eyeray::engine::test
