// The names of shapes, meshes and groups in a scene's file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace eyeray::engine {

// A tree of names: of objects, and of the groups that hold them. Each text is kept once, and each object of a
// name takes 12 bytes, however many copies of its groups there are. Objects copy only indices.
class Names {
 public:
  // The index of an object that has no name and is in no group that has one.
  static constexpr int32_t none = -1;

  // Adds an object called `text` in `group`, which is none or a result of add, and returns its index.
  // `number`: counts the objects of a batch that shares the name, from 1; 0: the object is in no batch.
  int32_t add(std::string_view text, uint32_t number, int32_t group);

  // The names of an object's groups, then its own, such as "cart/wheel 3"; "" for none.
  std::string path(int32_t index) const;

  // The number of names added.
  size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    uint32_t text;
    uint32_t number;
    int32_t group;
  };
  std::vector<Entry> entries_;
  std::vector<std::string> texts_;
  std::unordered_map<std::string, uint32_t> indices_;  // in texts_
};

// An object's name, or the name of the group that it is in.
struct NameRef {
  int32_t index = Names::none;
  bool own = false;  // false: it is the group's name
};

// `sphere "cart/wheel 3"`, `sphere in "cart"`, or "sphere".
std::string describe(std::string_view kind, const NameRef& name, const Names& names);

}  // namespace eyeray::engine
