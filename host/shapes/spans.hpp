// Stretches of one ray's line, and their parts in sets of points: lists of Spans in order, none touching
// another. Where two crossings are at the same t, the rest of them is that of the lower part.
#pragma once

#include <vector>

#include "host/scene/shape.hpp"

namespace eyeray::engine::shapes {

std::vector<Span> unite(const std::vector<Span>& a, const std::vector<Span>& b);
std::vector<Span> intersect(const std::vector<Span>& a, const std::vector<Span>& b);
std::vector<Span> subtract(const std::vector<Span>& a, const std::vector<Span>& b);

}  // namespace eyeray::engine::shapes
