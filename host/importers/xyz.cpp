// Reads XYZ: a point a line, x y z and perhaps more numbers. The format has no specification. Programs write
// colours and normals behind z, which the numbers themselves distinguish.
#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "host/core/diagnostic.hpp"
#include "host/core/free_memory.hpp"
#include "host/importers/cloud_builder.hpp"
#include "host/importers/formats.hpp"
#include "host/importers/mesh_builder.hpp"
#include "host/importers/number_lines.hpp"

namespace eyeray::engine::importers {

namespace {

constexpr size_t most_columns = 16;

// Decides whether three columns are colours or normals. They are normals if all are unit vectors. They are
// colours if all are integers from 0 to 255, and some above 1. They are also if all are shares from 0 to 1
// that are neither unit vectors nor all 0.
class TripleColumns {
 public:
  explicit TripleColumns(size_t first) : first_(first) {}

  void note(const std::vector<double>& numbers) {
    double squares = 0;
    for (size_t k = first_; k < first_ + 3; ++k) {
      const double value = numbers[k];
      codes_ = codes_ && value >= 0 && value <= 255 && value == std::floor(value);
      shares_ = shares_ && value >= 0 && value <= 1;
      above_zero_ = above_zero_ || value > 0;
      above_one_ = above_one_ || value > 1;
      squares += value * value;
    }
    units_ = units_ && std::fabs(squares - 1) < 0.02;
  }

  size_t first() const { return first_; }
  bool are_normals() const { return units_; }
  // The number of full brightness; empty if these are no colours.
  std::optional<double> brightest() const {
    if (codes_ && above_one_) return 255;
    if (shares_ && above_zero_ && !units_) return 1;
    return std::nullopt;
  }

 private:
  size_t first_;
  bool codes_ = true, shares_ = true, units_ = true;  // true of all lines
  bool above_zero_ = false, above_one_ = false;       // true of some
};

// The columns in which programs write colours and normals. Known orders: x y z r g b …; x y z intensity r g
// b; x y z nx ny nz r g b; x y z r g b nx ny nz.
std::vector<TripleColumns> candidates(size_t columns) {
  std::vector<TripleColumns> all;
  if (columns >= 6) all.emplace_back(3);
  if (columns == 7) all.emplace_back(4);
  if (columns >= 9) all.emplace_back(6);
  return all;
}

struct XyzRows {
  size_t columns = 0;
  std::vector<Vec3> positions;
  std::vector<float> rest;  // the other numbers of each line, if they may be colours or normals
  std::vector<TripleColumns> triples;
  std::optional<double> stated;  // the number of points that the first line states
};

XyzRows read_rows(const MeshFile& file, std::vector<std::string>& warnings) {
  NumberLines lines(file.bytes, file.name);
  XyzRows rows;
  std::vector<double> numbers;
  bool first_line = true;
  while (lines.next()) {
    if (std::exchange(first_line, false) && !lines.has_number()) {
      warnings.push_back(
          fmt::format("its first line was taken as a heading: {}", printable(lines.line().substr(0, 60))));
      continue;
    }
    lines.read(numbers, most_columns);
    if (numbers.size() == 1 && rows.columns == 0 && !rows.stated) {
      rows.stated = numbers[0];
      continue;
    }
    if (rows.columns == 0) {
      rows.columns = numbers.size();
      rows.triples = candidates(rows.columns);
    }
    if (numbers.size() < 3) lines.fail("a point needs three numbers, x y z");
    if (numbers.size() != rows.columns)
      lines.fail(
          fmt::format("this line has {} numbers, but the first point has {}", numbers.size(), rows.columns));
    rows.positions.emplace_back(numbers[0], numbers[1], numbers[2]);
    for (TripleColumns& each : rows.triples) each.note(numbers);
    if (!rows.triples.empty()) rows.rest.insert(rows.rest.end(), numbers.begin() + 3, numbers.end());
  }
  return rows;
}

}  // namespace

ImportedScene import_xyz(MeshFile& file) {
  ImportedScene scene;
  XyzRows rows = read_rows(file, scene.warnings);
  free_memory(file.bytes);  // the points need the memory
  const size_t count = rows.positions.size();
  if (rows.stated && *rows.stated != double(count))
    scene.warnings.push_back(
        fmt::format("its first line states {} points, but there are {}", *rows.stated, count));

  RawPoints points{file.name, std::move(rows.positions)};
  const auto values_of = [&](const TripleColumns& triple, std::vector<Vec3>& values, const auto& convert) {
    values.reserve(count);
    const size_t width = rows.columns - 3;
    for (size_t i = 0; i < count; ++i) {
      const float* const at = &rows.rest[i * width + triple.first() - 3];
      values.push_back(convert(Vec3(at[0], at[1], at[2])));
    }
  };
  const bool disks = file.options.point_shape == PointShape::disk;
  for (const TripleColumns& each : rows.triples) {
    const auto brightest = each.brightest();
    if (brightest && points.colors.empty())
      values_of(each, points.colors, [&](const Vec3& v) { return color_from_display(v / *brightest); });
    if (disks && each.are_normals() && points.normals.empty())
      values_of(each, points.normals, [](const Vec3& v) { return v; });
  }
  free_memory(rows.rest);
  const size_t shown = 3 + (points.colors.empty() ? 0 : 3) + (points.normals.empty() ? 0 : 3);
  if (shown < rows.columns)
    scene.warnings.push_back(fmt::format(
        "{} of its {} columns were left out: only x y z{}{} are shown", rows.columns - shown, rows.columns,
        points.normals.empty() ? "" : ", normals", points.colors.empty() ? "" : " and a color"));
  if (auto cloud = build_cloud(std::move(points), file.options, scene.warnings))
    scene.clouds.push_back({std::move(cloud)});
  return scene;
}

}  // namespace eyeray::engine::importers
