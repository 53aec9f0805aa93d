#include "host/pack/environment_records.hpp"

#include <algorithm>

#include "host/core/parallel_for.hpp"

namespace eyeray::engine::pack {

size_t environment_texels(const EnvironmentMap& environment) {
  return (size_t(environment.width()) + 1) * (size_t(environment.height()) + 1);
}

RawVector<shader::uvec4> pack_environment(const EnvironmentMap& environment) {
  const int width = environment.width(), height = environment.height();
  const EnvironmentCells& cells = environment.cells();
  RawVector<shader::uvec4> packed;
  packed.resize(environment_texels(environment));
  parallel_for(0, height + 1, [&](int row) {
    for (int column = 0; column <= width; ++column) {
      const size_t cell = size_t(row) * size_t(width) + size_t(column);
      shader::uvec4& texel = packed[cell + size_t(row)];
      texel = records::to_bits(
          records::to_vec4(environment.texel(column == width ? 0 : column, std::min(row, height - 1))));
      texel.w = column == width ? cells.row_ends[size_t(row)] : cells.column_ends[cell];
    }
  });
  return packed;
}

}  // namespace eyeray::engine::pack
