// Operations on sets of points, by their stretches of one ray's line: lists of Spans in order, none touching
// another. Where two crossings are at the same t, the one that remains is that of the lower part.
#pragma once

#include <vector>

#include "host/scene/shape.hpp"

namespace eyeray::engine::shapes {

std::vector<Span> unite(const std::vector<Span>& a, const std::vector<Span>& b);
std::vector<Span> intersect(const std::vector<Span>& a, const std::vector<Span>& b);
std::vector<Span> subtract(const std::vector<Span>& a, const std::vector<Span>& b);

}  // namespace eyeray::engine::shapes
