#include "host/emulator/location.hpp"

#include <fmt/format.h>

#include <spirv-tools/libspirv.h>

namespace eyeray::engine::emulator {

std::string describe(const Location& location, const std::vector<std::string>& files) {
  const std::string instruction = fmt::format("Op{}{}", spvOpcodeString(location.opcode),
                                              location.id ? fmt::format(" %{}", location.id) : "");
  if (location.line == 0) return instruction;
  const std::string column = location.column ? fmt::format(":{}", location.column) : "";
  return fmt::format("{}:{}{} ({})", files[location.file], location.line, column, instruction);
}

}  // namespace eyeray::engine::emulator
