// The groups of a scene's files: their members, the number of their copies, and the choice of those that are
// instanced. Private to the loader.
#pragma once

#include <toml++/toml.h>

#include <deque>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/diagnostic_log.hpp"
#include "host/reading/number_expression.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::loader {

class GroupPlan {
 public:
  // Reads only the structure of the tables; the reader of each table reports the faults within it. Reports
  // groups that contain themselves, and groups that make too many objects for any memory. `variables`: those
  // of [let].
  GroupPlan(const toml::table& root, GroupStorage storage, reading::Variables& variables, DiagnosticLog& log);

  // True if the groups can be shown; false after errors.
  bool sound() const { return sound_; }

  // True if copies of the group in the world are instances.
  bool is_instanced(const toml::table& group) const;

  // True if the group is a pattern, which only instances show.
  static bool is_pattern(const toml::table& group);

  // The top-level group of that name, or null.
  const toml::table* find(std::string_view name) const;
  std::vector<std::string_view> names() const;
  // The patterns that no instance shows.
  std::vector<const toml::table*> idle() const;

 private:
  // A group, or the scene. Counts are floating-point numbers, since nested batches may multiply to huge ones.
  struct Node {
    const toml::table* table = nullptr;
    std::string_view name;  // "" for a group within a group, too
    bool is_scene = false;
    struct Member {
      Node* group;
      double count;  // the number of its copies in one copy of the node
    };
    std::vector<Member> members;
    double own = 0;                          // number of its own shapes and meshes, …
    double items = 0;                        // … also with those of its groups, …
    double objects = 0;                      // … and also with the groups themselves
    bool bounded = true;                     // true if all its items are bounded
    std::vector<std::string_view> counters;  // counters of its `repeat`, and of the groups around it
    int height = 0;                          // depth of nested groups below it
    enum class Visit { none, begun, done } visit = Visit::none;
    double shown = 0;  // number of its copies in the world, except those within an instance
    bool instanced = false;
    bool idle = false;
  };

  double copies(const toml::table& table);
  double count_shapes(const toml::table& table);
  Node& node_of(const toml::table& table);
  void enter_names(const toml::table& root);
  void link(Node& node);
  void link_instances(Node& node, const toml::table& table);
  void visit(Node& node, std::vector<std::string_view>& chain);
  void choose(Node& node, GroupStorage storage);
  void check_counts(const Node& root);
  void fail(const toml::node& at, std::string message);

  reading::Variables& variables_;
  DiagnosticLog& log_;
  std::deque<Node> nodes_;
  std::map<const toml::table*, Node*> by_table_;
  std::map<std::string, Node*, std::less<>> by_name_;
  std::set<std::string, std::less<>> shared_names_;
  std::vector<Node*> children_first_;
  bool sound_ = true;
};

}  // namespace eyeray::engine::loader
