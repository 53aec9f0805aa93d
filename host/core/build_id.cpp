#include "host/core/build_id.hpp"

#include <elf.h>
#include <fmt/format.h>
#include <link.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <span>

#include "host/core/content_hash.hpp"

namespace eyeray {
namespace {

// Notes of an ELF file come one after the other, name and contents rounded up to four bytes.
std::string build_id_in(std::span<const std::byte> notes) {
  const auto rounded = [](size_t size) { return (size + 3) & ~size_t{3}; };
  while (notes.size() >= sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) note;
    std::memcpy(&note, notes.data(), sizeof note);
    const size_t name = sizeof note, contents = name + rounded(note.n_namesz);
    const size_t end = contents + rounded(note.n_descsz);
    if (end > notes.size()) break;
    if (note.n_type == NT_GNU_BUILD_ID && note.n_namesz == 4 && std::memcmp(&notes[name], "GNU", 4) == 0) {
      std::string hex;
      for (const std::byte byte : notes.subspan(contents, note.n_descsz))
        hex += fmt::format("{:02x}", unsigned(byte));
      return hex;
    }
    notes = notes.subspan(end);
  }
  return "";
}

// Of the first object that is loaded, which is the program itself.
int take_build_id(dl_phdr_info* object, size_t, void* result) {
  std::string& id = *static_cast<std::string*>(result);
  for (const ElfW(Phdr) & segment : std::span(object->dlpi_phdr, object->dlpi_phnum)) {
    if (segment.p_type != PT_NOTE || !id.empty()) continue;
    const auto* begin = reinterpret_cast<const std::byte*>(object->dlpi_addr + segment.p_vaddr);
    id = build_id_in({begin, size_t(segment.p_memsz)});
  }
  return 1;
}

}  // namespace

std::string build_id() {
  std::string id;
  dl_iterate_phdr(take_build_id, &id);
  return id.empty() ? hash_of_files(std::array{std::filesystem::path("/proc/self/exe")}) : id;
}

}  // namespace eyeray
