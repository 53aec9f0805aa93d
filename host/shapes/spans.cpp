#include "host/shapes/spans.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>

namespace eyeray::engine::shapes {

namespace {

bool before(const Intersection& a, const Intersection& b) {
  return std::tie(a.t, a.part) < std::tie(b.t, b.part);
}

// The earlier or the later of two crossings. At equal t it is always the crossing of the part with the lower
// number.
const Intersection& earlier(const Intersection& a, const Intersection& b) {
  return before(b, a) ? b : a;
}
const Intersection& later(const Intersection& a, const Intersection& b) {
  return a.t == b.t ? earlier(a, b) : a.t < b.t ? b : a;
}

void add(std::vector<Span>& spans, const Intersection& in, const Intersection& out) {
  if (in.t < out.t) spans.push_back({in, out});
}

}  // namespace

std::vector<Span> unite(const std::vector<Span>& a, const std::vector<Span>& b) {
  std::vector<Span> both;
  std::ranges::merge(a, b, std::back_inserter(both), before, &Span::in, &Span::in);
  std::vector<Span> all;
  for (const Span& span : both) {
    if (all.empty() || span.in.t > all.back().out.t)
      all.push_back(span);
    else
      all.back().out = later(all.back().out, span.out);
  }
  return all;
}

std::vector<Span> intersect(const std::vector<Span>& a, const std::vector<Span>& b) {
  std::vector<Span> all;
  for (auto i = a.begin(), k = b.begin(); i != a.end() && k != b.end();) {
    add(all, later(i->in, k->in), earlier(i->out, k->out));
    if (i->out.t < k->out.t)
      ++i;
    else
      ++k;
  }
  return all;
}

std::vector<Span> subtract(const std::vector<Span>& a, const std::vector<Span>& b) {
  std::vector<Span> all;
  for (const Span& span : a) {
    Intersection in = span.in;
    bool open = true;
    for (const Span& cut : b) {
      if (cut.out.t < in.t) continue;
      if (cut.in.t > span.out.t) break;
      if (cut.in.t > in.t) add(all, in, earlier(cut.in, span.out));
      in = later(in, cut.out);
      open = cut.out.t < span.out.t;
    }
    if (open) add(all, in, span.out);
  }
  return all;
}

}  // namespace eyeray::engine::shapes
