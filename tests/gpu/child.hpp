#pragma once

#include <string_view>

#include "support.hpp"

namespace eyeray::test {

// "list": names the devices on standard output; "endless": work that outlasts its time-out.
void child_work(std::string_view name);

}  // namespace eyeray::test
