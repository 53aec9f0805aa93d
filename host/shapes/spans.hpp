// Operations on sets of points along one ray's line. A set is a list of Spans in order, none touching
// another. If two crossings are at the same t, the crossing of the part with the lower number remains.
#pragma once

#include <vector>

#include "host/scene/shape.hpp"

namespace eyeray::engine::shapes {

std::vector<Span> unite(const std::vector<Span>& a, const std::vector<Span>& b);
std::vector<Span> intersect(const std::vector<Span>& a, const std::vector<Span>& b);
std::vector<Span> subtract(const std::vector<Span>& a, const std::vector<Span>& b);

}  // namespace eyeray::engine::shapes
