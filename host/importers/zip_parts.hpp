// The parts of a package in ZIP form (ECMA-376-2, Open Packaging Conventions), as 3MF files are. Private to
// the importers.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>

namespace eyeray::engine::importers {

class ZipParts {
 public:
  // `bytes` and `file`, the name for messages, must outlive the parts. InputError if it is no ZIP.
  ZipParts(const std::string& bytes, const std::string& file);
  ~ZipParts();
  ZipParts(const ZipParts&) = delete;
  ZipParts& operator=(const ZipParts&) = delete;

  // The form of a name that is compared: without a slash in front, in lower case.
  static std::string key(std::string_view part);
  bool has(std::string_view part) const;
  // The name of a part that it has, as the package writes it.
  const std::string& name(std::string_view part) const;
  // Unpacks a part, piece by piece. InputError if there is no such part, if it is damaged or encrypted, or if
  // all that was unpacked exceeds the bound for files of this size. `take` may throw.
  using Take = std::function<void(std::string_view piece, bool last)>;
  void read(std::string_view part, const Take& take);
  // A whole part.
  std::string read(std::string_view part);

 private:
  struct Source;  // the bytes, as minizip reads them
  struct Place {
    uint64_t directory, number;
    std::string name;
  };

  const Place& find(std::string_view part) const;

  const std::string& file_;
  std::unique_ptr<Source> source_;
  void* zip_ = nullptr;  // unzFile
  std::unordered_map<std::string, Place> places_;
  uint64_t left_;  // bytes that may still be unpacked
};

}  // namespace eyeray::engine::importers
