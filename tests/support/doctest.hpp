// doctest's short names, where core/error.hpp has taken some of them for itself. Included after everything
// else.
#pragma once

#include "host/core/error.hpp"

#undef CHECK
#undef CHECK_EQ
#undef CHECK_LT
#undef CHECK_LE

#include <doctest/doctest.h>
