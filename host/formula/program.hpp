// What the translators need to know of a formula's text, found without compiling it. Private to this layer.
#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formula/fault.hpp"
#include "formula/token.hpp"

namespace eyeray::formula {

struct Program {
  enum class Role { other, type, built_in, name, swizzle };

  // Tokens [begin, end).
  struct Range {
    size_t begin, end;
  };
  struct Index {
    Range brackets;  // of an access to an array of `size`
    size_t size;
  };
  struct Function {
    std::string type;
    std::string name;
    Range body;  // with its braces; empty for a declaration
  };

  std::vector<Token> tokens;
  std::vector<Role> roles;      // of each token
  std::vector<size_t> partner;  // of each bracket; elsewhere none
  std::vector<Function> functions;
  std::vector<Range> conditions;     // of loops whose turns are to be counted; may be empty
  std::vector<Index> indices;        // into arrays
  std::vector<Range> lists;          // float[2] of float[2](1, 2)
  std::set<size_t> sizes;            // the numbers in declarations of arrays
  std::set<size_t> float_constants;  // `const` of floats and vectors
  std::set<size_t> directions;       // `in`, `out`, `inout` of parameters
  std::set<size_t> reference_types;  // types of `out` and `inout` parameters
  std::set<size_t> stored_swizzles;  // that are assigned to, or may be

  static constexpr size_t none = size_t(-1);
};

// `parameters`: names that the text may use as constants. The program is whole only if there are no faults.
Program analyse(std::string_view text, std::span<const std::string> parameters, std::vector<Fault>& faults);

}  // namespace eyeray::formula
