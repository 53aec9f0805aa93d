#include "host/compute/source_lines.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "host/spirv/module.hpp"
#include "host/spirv/words.hpp"

namespace eyeray::engine::compute {
namespace {

constexpr uint32_t debug_source = 35;  // an instruction of NonSemantic.Shader.DebugInfo.100
constexpr uintmax_t most_source_bytes = 64 << 20;

}  // namespace

SourceLines::SourceLines(std::span<const uint32_t> spirv) {
  std::map<uint32_t, std::string> strings;
  std::string file;  // the one of the last OpSource
  uint32_t debug = 0;
  for (const spirv::Instruction& i : spirv::read(spirv).declarations) {
    switch (spirv::opcode_of(i)) {
      case spv::OpString:
        strings[i[1]] = spirv::string_at(i, 2);
        break;
      case spv::OpExtInstImport:
        if (spirv::string_at(i, 2) == "NonSemantic.Shader.DebugInfo.100") debug = i[1];
        break;
      case spv::OpSource:
        if (i.size() > 4) embedded_[file = strings[i[3]]] = spirv::string_at(i, 4);
        break;
      case spv::OpSourceContinued:
        embedded_[file] += spirv::string_at(i, 1);
        break;
      case spv::OpExtInst:
        if (i[3] == debug && i[4] == debug_source && i.size() > 6) embedded_[strings[i[5]]] = strings[i[6]];
        break;
      default:
        break;
    }
  }
  // glslang writes its own lines first, and then this one.
  const std::string start = "#line 1\n";
  for (auto& [name, text] : embedded_)
    if (const size_t at = text.find(start);
        text.starts_with("// OpModuleProcessed") && at != std::string::npos)
      text.erase(0, at + start.size());
}

std::string SourceLines::line(const std::string& file, uint32_t number) {
  const auto [found, is_new] = read_.try_emplace(file);
  if (is_new) {
    std::string text = embedded_[file];
    std::error_code none;
    if (std::filesystem::is_regular_file(file, none) &&
        std::filesystem::file_size(file, none) <= most_source_bytes)
      text = (std::ostringstream() << std::ifstream(file).rdbuf()).str();
    std::istringstream lines(text);
    for (std::string each; std::getline(lines, each);) {
      each.erase(each.find_last_not_of(" \t\r") + 1);
      found->second.push_back(each);
    }
  }
  return number > 0 && number <= found->second.size() ? found->second[number - 1] : "";
}

}  // namespace eyeray::engine::compute
