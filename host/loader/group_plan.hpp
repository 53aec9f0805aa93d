// The groups of a scene's files: which holds which, how often each is placed, and which of them are
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
#include "host/scene/scene.hpp"

namespace eyeray::engine::loader {

class GroupPlan {
 public:
  // Goes by the tables' outlines: faults within them are for others to report. Groups that hold themselves
  // or come to more than any memory holds are errors here.
  GroupPlan(const toml::table& root, GroupStorage storage, DiagnosticLog& log);

  // True if the groups can be shown; if not, there were errors.
  bool sound() const { return sound_; }

  // True if the group is instanced where it stands in the world.
  bool is_instanced(const toml::table& group) const;

  // True if a group stands only where instances show it.
  static bool is_pattern(const toml::table& group);

  // The group of that name that is in no other, or null.
  const toml::table* find(std::string_view name) const;
  std::vector<std::string_view> names() const;
  // Patterns that nothing shows.
  std::vector<const toml::table*> idle() const;

 private:
  // A group, or the scene. Counts are floating-point numbers: batches of groups in groups multiply.
  struct Node {
    const toml::table* table = nullptr;
    std::string_view name;  // "" of those in groups, too
    bool is_scene = false;
    struct Member {
      Node* group;
      double count;  // the number of its copies in one of these nodes
    };
    std::vector<Member> members;
    double own = 0;       // its own shapes and meshes, …
    double items = 0;     // … with those of its groups, …
    double objects = 0;   // … and with the groups themselves
    bool bounded = true;  // all of it
    int height = 0;       // of groups in groups
    enum class Visit { none, begun, done } visit = Visit::none;
    double shown = 0;  // in the world, not counting where it is a part of an instance
    bool instanced = false;
    bool idle = false;
  };

  Node& node_of(const toml::table& table);
  void enter_names(const toml::table& root);
  void link(Node& node);
  void link_instances(Node& node, const toml::table& table);
  void visit(Node& node, std::vector<std::string_view>& chain);
  void choose(Node& node, GroupStorage storage);
  void check_counts(const Node& root);
  void fail(const toml::node& at, std::string message);

  DiagnosticLog& log_;
  std::deque<Node> nodes_;
  std::map<const toml::table*, Node*> by_table_;
  std::map<std::string, Node*, std::less<>> by_name_;
  std::set<std::string, std::less<>> shared_names_;
  std::vector<Node*> children_first_;
  bool sound_ = true;
};

}  // namespace eyeray::engine::loader
