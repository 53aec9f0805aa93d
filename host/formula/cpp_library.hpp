// C++ compiled and loaded while the program runs. Private to this layer.
#pragma once

#include <memory>
#include <string>

#include "core/disk_cache.hpp"

namespace eyeray::formula {

// A shared object in memory, unloaded with the last reference.
class CppLibrary {
 public:
  ~CppLibrary();
  CppLibrary(const CppLibrary&) = delete;
  CppLibrary& operator=(const CppLibrary&) = delete;

  // Compiled from one translation unit by $CXX, c++, g++ or clang++, whichever is found first, or what was
  // made of the same text before. Error (no_compiler) where there is none, or it does not take the text;
  // `what` is then named as what could not be compiled.
  static std::shared_ptr<const CppLibrary> load(const std::string& unit, const std::string& what,
                                                const DiskCache& cache);

  // The address of an extern "C" function, which must be there.
  void* symbol(const char* name) const;

 private:
  // A file in memory, open as long as the library is.
  struct Opened {
    int file;
    void* handle;
  };
  static Opened open(const std::string& bytes);
  explicit CppLibrary(const Opened& opened) : opened_(opened) {}
  Opened opened_;
};

// Whether there is any compiler.
bool has_cpp_compiler();

}  // namespace eyeray::formula
