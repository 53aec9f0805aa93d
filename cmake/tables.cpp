// Computes the tables of host/tables while eyeray is built: tables FILE.cpp
#include "host/optics/glass_albedo.hpp"
#include "host/tables/albedos.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <fstream>
#include <string>
#include <vector>

#include "host/core/parallel_for.hpp"

using namespace eyeray::engine;

namespace {

std::string text_of(double number) {
  return fmt::format("{}", number);
}
std::string text_of(const optics::GgxAlbedo& of) {
  return fmt::format("{{{}, {}, {}, {}}}", of.once, of.edge, of.mean_once, of.mean_edge);
}
std::string text_of(const optics::SheenAlbedo& of) {
  return fmt::format("{{{}, {}}}", of.unweakened, of.albedo);
}

// An array of `rows` rows, each a vector: row(number).
template <typename Row>
std::string array(const char* type, const char* name, int rows, const Row& row) {
  std::vector<std::string> texts(static_cast<size_t>(rows));
  parallel_for(0, rows, [&](int j) {
    for (const auto& entry : row(j)) texts[size_t(j)] += text_of(entry) + ",\n";
  });
  return fmt::format("extern const {} {}[] = {{\n{}}};\n", type, name, fmt::join(texts, ""));
}

// Row j of all ends of slices, one after the other.
std::vector<double> glass_row(int j) {
  constexpr double step = 1.0 / (tables::glass_side - 1);
  const double contrast = tables::glass_contrast(j / tables::glass_side);
  std::vector<double> row;
  for (int i = 0; i < tables::glass_side; ++i)
    row.push_back(optics::glass_albedo_integral((i * step) * (i * step), j % tables::glass_side * step,
                                                1 - contrast, 1 + contrast));
  return row;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  std::ofstream out(arguments[1]);
  out << "#include \"host/tables/albedos.hpp\"\nnamespace eyeray::engine::tables {\n"
      << array("optics::GgxAlbedo", "ggx_numbers", tables::ggx_side,
               [](int j) { return optics::ggx_albedo_row(tables::ggx_side, j / (tables::ggx_side - 1.0)); })
      << array("optics::SheenAlbedo", "sheen_numbers", tables::sheen_side,
               [](int j) {
                 return optics::sheen_albedo_row(tables::sheen_side, j / (tables::sheen_side - 1.0));
               })
      << array("double", "glass_numbers", (tables::glass_slices + 1) * tables::glass_side, glass_row)
      << "}\n";
  out.close();
  return out ? 0 : 1;
}
