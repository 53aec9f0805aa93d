#include "host/importers/gltf_links.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "host/importers/gltf_components.hpp"

namespace eyeray::engine::importers {

namespace {

using Json = nlohmann::json;

// The functions below return null, `no_object`, the fallback or an empty list if the type of the document's
// value is not glTF's.
constexpr size_t no_object = ~size_t{0};

const Json* member(const Json& object, std::string_view key) {
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

const Json& list(const Json& object, std::string_view key) {
  static const Json none = Json::array();
  const Json* const found = member(object, key);
  return found && found->is_array() ? *found : none;
}

uint64_t count(const Json& object, std::string_view key, uint64_t fallback) {
  const Json* const found = member(object, key);
  return found && found->is_number_unsigned() ? found->get<uint64_t>() : fallback;
}

size_t as_index(const Json& value, size_t size) {
  return value.is_number_unsigned() && value.get<uint64_t>() < size ? value.get<size_t>() : no_object;
}

size_t index(const Json& object, std::string_view key, size_t size) {
  const Json* const found = member(object, key);
  return found ? as_index(*found, size) : no_object;
}

// The tree of nodes. A walk numbers them so that each node comes before all nodes below it.
class Tree {
 public:
  explicit Tree(const Json& nodes)
      : nodes_(nodes),
        parents_(nodes.size()),
        first_(nodes.size(), no_object),
        last_(nodes.size()),
        roots_(nodes.size()) {
    for (const Json& node : nodes) {
      for (const Json& child : list(node, "children")) {
        if (const size_t below = as_index(child, nodes.size()); below != no_object) ++parents_[below];
      }
    }
    for (size_t i = 0; i < nodes.size(); ++i)
      if (parents_[i] == 0) walk(i);
  }

  size_t parents(size_t node) const { return parents_[node]; }
  // True if no walk from a node without parents reaches this node: it is in a loop, or below one.
  bool is_in_loop(size_t node) const { return first_[node] == no_object; }
  size_t root(size_t node) const { return roots_[node]; }
  bool is_at_or_below(size_t node, size_t above) const {
    return first_[above] <= first_[node] && first_[node] <= last_[above];
  }

 private:
  void walk(size_t root) {
    std::vector<std::pair<size_t, size_t>> path;  // nodes, and the number of their children that are done
    const auto enter = [&](size_t node) {
      roots_[node] = root;
      first_[node] = next_++;
      path.emplace_back(node, 0);
    };
    enter(root);
    while (!path.empty()) {
      auto& [node, done] = path.back();
      const Json& children = list(nodes_[node], "children");
      if (done == children.size()) {
        last_[node] = next_ - 1;
        path.pop_back();
        continue;
      }
      const size_t child = as_index(children[done++], nodes_.size());
      if (child != no_object && is_in_loop(child)) enter(child);
    }
  }

  const Json& nodes_;
  std::vector<size_t> parents_;  // number of each node's parents
  std::vector<size_t> first_;    // the walk's number of each node; last_: of the last node below it
  std::vector<size_t> last_;
  std::vector<size_t> roots_;
  size_t next_ = 0;
};

// The meaning of an accessor's elements, as bits.
struct Role {
  static constexpr unsigned attribute = 1, corner = 2, other = 4;
  static constexpr unsigned any = attribute | corner | other;
  static constexpr unsigned bounded = 8;  // set beside another role: the accessor needs min and max
};

// The roles of accessors, and those of views, which follow from them.
struct Roles {
  explicit Roles(const Json& document)
      : accessors(list(document, "accessors").size()),
        views(list(document, "bufferViews").size()),
        sharing(views.size()) {
    for (const Json& mesh : list(document, "meshes")) {
      for (const Json& primitive : list(mesh, "primitives")) {
        if (const Json* attributes = member(primitive, "attributes")) add_attributes(*attributes);
        for (const Json& target : list(primitive, "targets")) add_attributes(target);
        add(primitive, "indices", Role::corner);
      }
    }
    for (const Json& skin : list(document, "skins")) add(skin, "inverseBindMatrices", Role::other);
    for (const Json& animation : list(document, "animations")) {
      for (const Json& sampler : list(animation, "samplers")) {
        add(sampler, "input", Role::other | Role::bounded);
        add(sampler, "output", Role::other);
      }
    }
    for (size_t i = 0; i < accessors.size(); ++i) {
      const size_t view = index(list(document, "accessors")[i], "bufferView", views.size());
      if (view == no_object) continue;
      views[view] |= accessors[i];
      if (accessors[i] & Role::attribute) ++sharing[view];
    }
  }

  void add(const Json& object, std::string_view key, unsigned role) {
    if (const size_t i = index(object, key, accessors.size()); i != no_object) accessors[i] |= role;
  }
  void add_attributes(const Json& attributes) {
    for (const auto& [name, unused] : attributes.items())
      add(attributes, name, name == "POSITION" ? Role::attribute | Role::bounded : Role::attribute);
  }

  std::vector<unsigned> accessors;
  std::vector<unsigned> views;
  std::vector<size_t> sharing;  // number of attributes' accessors in each view
};

struct Links {
  explicit Links(const Json& json) : document(json), tree(list(json, "nodes")), roles(json) {}

  const Json& document;
  Tree tree;
  Roles roles;
};

// True if `value_of` has different values for the primitives of a mesh.
template <typename Value>
bool differ(const Json& mesh, const Value& value_of) {
  const Json& primitives = list(mesh, "primitives");
  return std::ranges::any_of(
      primitives, [&](const Json& primitive) { return value_of(primitive) != value_of(primitives[0]); });
}

size_t sets_of_joints(const Json& primitive) {
  size_t sets = 0;
  if (const Json* attributes = member(primitive, "attributes"))
    while (attributes->contains(fmt::format("JOINTS_{}", sets))) ++sets;
  return sets;
}

// True if `holds` is true of all joints of a skin that are in the tree.
template <typename Holds>
bool all_joints(const Links& links, const Json& skin, const Holds& holds) {
  return std::ranges::all_of(list(skin, "joints"), [&](const Json& value) {
    const size_t joint = as_index(value, list(links.document, "nodes").size());
    return joint == no_object || links.tree.is_in_loop(joint) || holds(joint);
  });
}

bool has_common_root(const Links& links, const Json& skin) {
  size_t root = no_object;
  return all_joints(links, skin, [&](size_t joint) {
    if (root == no_object) root = links.tree.root(joint);
    return links.tree.root(joint) == root;
  });
}

bool has_sound_skeleton(const Links& links, const Json& skin) {
  const size_t skeleton = index(skin, "skeleton", list(links.document, "nodes").size());
  return skeleton == no_object || links.tree.is_in_loop(skeleton) ||
         all_joints(links, skin, [&](size_t joint) { return links.tree.is_at_or_below(joint, skeleton); });
}

// True if each element of an attribute begins at a multiple of 4 bytes of its view.
bool is_aligned(const Links& links, const Json& accessor) {
  const Json& views = list(links.document, "bufferViews");
  const size_t view = index(accessor, "bufferView", views.size());
  if (view == no_object) return true;
  const Json* const type = member(accessor, "type");
  const size_t components = type && type->is_string() ? components_of(type->get<std::string>()) : 0;
  const uint64_t size = components * bytes_of(count(accessor, "componentType", 0));
  return count(accessor, "byteOffset", 0) % 4 == 0 && count(views[view], "byteStride", size) % 4 == 0;
}

constexpr uint64_t target_attributes = 34962, target_corners = 34963;

bool fits_target(unsigned roles, uint64_t target) {
  if (target == target_attributes) return (roles & (Role::corner | Role::other)) == 0;
  return target != target_corners || (roles & (Role::attribute | Role::other)) == 0;
}

// A row of the table: a list of the document, and a rule that each object of the list must keep.
struct LinkRule {
  std::string_view list;
  std::string_view breach;
  bool (*is_broken)(const Links& links, const Json& object, size_t index);
};

constexpr LinkRule link_rules[] = {
    {"nodes", "nodes of several parents",
     [](const Links& links, const Json&, size_t i) { return links.tree.parents(i) > 1; }},
    {"nodes", "nodes in or below a loop",
     [](const Links& links, const Json&, size_t i) { return links.tree.is_in_loop(i); }},
    {"nodes", "nodes with a skin, weights or instances but no mesh, which have no effect",
     [](const Links&, const Json& node, size_t) {
       const Json* const extensions = member(node, "extensions");
       return !node.contains("mesh") && (node.contains("skin") || node.contains("weights") ||
                                         (extensions && extensions->contains("EXT_mesh_gpu_instancing")));
     }},
    {"meshes", "meshes whose primitives differ in their number of morph targets",
     [](const Links&, const Json& mesh, size_t) {
       return differ(mesh, [](const Json& primitive) { return list(primitive, "targets").size(); });
     }},
    {"meshes", "meshes whose primitives differ in their number of sets of joints",
     [](const Links&, const Json& mesh, size_t) { return differ(mesh, sets_of_joints); }},
    {"skins", "skins whose joints have no common root, used where they are",
     [](const Links& links, const Json& skin, size_t) { return !has_common_root(links, skin); }},
    {"skins", "skins whose skeleton is not above all joints, left out",
     [](const Links& links, const Json& skin, size_t) { return !has_sound_skeleton(links, skin); }},
    {"cameras", "cameras whose type is not that of their values, which are used",
     [](const Links&, const Json& camera, size_t) {
       const Json* const type = member(camera, "type");
       return !type || !type->is_string() || !camera.contains(type->get<std::string>());
     }},
    {"images", "pictures with both or neither of uri and bufferView",
     [](const Links&, const Json& image, size_t) {
       return image.contains("uri") == image.contains("bufferView");
     }},
    {"accessors", "accessors that are more than one of attributes, indices and other data",
     [](const Links& links, const Json&, size_t i) {
       return std::popcount(links.roles.accessors[i] & Role::any) > 1;
     }},
    {"accessors", "accessors of positions or times without min and max",
     [](const Links& links, const Json& accessor, size_t i) {
       return (links.roles.accessors[i] & Role::bounded) &&
              !(accessor.contains("min") && accessor.contains("max"));
     }},
    {"accessors", "accessors of attributes whose elements do not begin at multiples of 4 bytes",
     [](const Links& links, const Json& accessor, size_t i) {
       return (links.roles.accessors[i] & Role::attribute) && !is_aligned(links, accessor);
     }},
    {"bufferViews", "views that contain more than one of attributes, indices and other data",
     [](const Links& links, const Json&, size_t i) {
       return std::popcount(links.roles.views[i] & Role::any) > 1;
     }},
    {"bufferViews", "views whose target does not fit their accessors",
     [](const Links& links, const Json& view, size_t i) {
       return !fits_target(links.roles.views[i], count(view, "target", 0));
     }},
    {"bufferViews", "views of several attributes without a byteStride, read as packed",
     [](const Links& links, const Json& view, size_t i) {
       return links.roles.sharing[i] > 1 && !view.contains("byteStride");
     }},
};

}  // namespace

void check_links(const Json& document, GltfBreaches& breaches) {
  const Links links(document);
  for (const LinkRule& rule : link_rules) {
    const Json& objects = list(document, rule.list);
    for (size_t i = 0; i < objects.size(); ++i) {
      if (objects[i].is_object() && rule.is_broken(links, objects[i], i))
        breaches.add(rule.breach, fmt::format("{}[{}]", rule.list, i));
    }
  }
}

}  // namespace eyeray::engine::importers
