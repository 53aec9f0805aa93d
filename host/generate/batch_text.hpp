// Many shapes as one table of a scene file, in the fewest digits that are exact.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/error.hpp"
#include "host/core/vec.hpp"

namespace eyeray::engine::generate {

class BatchText {
 public:
  // `table`: for example "sphere". `common`: the lines that hold for every shape. `keys`: the keys of which
  // every shape has its own value.
  BatchText(std::string_view table, std::string common, const std::vector<std::string_view>& keys);

  // A shape: a value for each key, which is a number, a point, a list of points or a name.
  template <typename... Values>
  void add(const Values&... values) {
    size_t list = 0;
    ((append(lists_[list].values, values), lists_[list++].values += ",\n"), ...);
    CHECK_EQ(list, lists_.size());
  }

  // "" without shapes.
  std::string text() const;

 private:
  struct List {
    std::string_view key;
    std::string values;
  };

  static void append(std::string& text, double number);
  static void append(std::string& text, const std::string& name);
  static void append(std::string& text, const Vec3& point);
  static void append(std::string& text, std::span<const Vec3> points);

  std::string_view table_;
  std::string common_;
  std::vector<List> lists_;
};

}  // namespace eyeray::engine::generate
