#include "host/loader/group_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "host/loader/sections.hpp"
#include "host/loader/variables.hpp"
#include "host/reading/source_position.hpp"

namespace eyeray::engine::loader {

namespace {

// Limit on the objects that are stored one by one, shown or not.
constexpr double most_kept = 0x4000000;
// Limit on the objects shown: primitives' ids have 31 bits.
constexpr double most_shown = std::numeric_limits<int32_t>::max();
constexpr int deepest = 64;

// An instance takes about as much memory as this many shapes.
constexpr double instance_cost = 2;
// Objects that instancing a group must save. Rays traverse an instanced group separately, which costs time.
constexpr double worth_keeping_once = 0x40000;

// The number of copies that the table's batch makes. A faulty batch counts as one.
double batch_size(const toml::table& table) {
  const toml::table* batch = table[batch_key].as_table();
  if (!batch || batch->empty()) return 1;
  const toml::array* values = batch->begin()->second.as_array();
  return values ? double(values->size()) : 1;
}

// The tables in the list `name` of a table.
std::vector<const toml::table*> tables(const toml::table& holder, std::string_view name) {
  std::vector<const toml::table*> found;
  const toml::array* list = holder[name].as_array();
  if (!list) return found;
  for (const toml::node& node : *list)
    if (const toml::table* table = node.as_table()) found.push_back(table);
  return found;
}

}  // namespace

// The number of objects that the table's batch or `repeat` makes.
double GroupPlan::copies(const toml::table& table) {
  return batch_size(table) * repeat_size(table, variables_);
}

// The number of shapes and CSG objects in a shape's table, including itself, the parts of a CSG object, and
// its copies.
double GroupPlan::count_shapes(const toml::table& table) {
  double count = 1;
  for (const toml::table* held : {&table, table[minus_key].as_table()}) {
    if (!held) continue;
    for (const std::string_view name : placed_names())
      for (const toml::table* part : tables(*held, name)) count += count_shapes(*part);
  }
  return count * copies(table);
}

GroupPlan::GroupPlan(const toml::table& root, GroupStorage storage, reading::Variables& variables,
                     DiagnosticLog& log)
    : variables_(variables), log_(log) {
  enter_names(root);
  Node& scene = node_of(root);
  scene.is_scene = true;
  std::vector<std::string_view> chain;
  visit(scene, chain);
  for (const auto& [name, node] : by_name_) {
    node->idle = node->visit == Node::Visit::none;
  }
  for (const auto& [name, node] : by_name_) visit(*node, chain);
  if (!sound_) return;

  // Visit each group after all groups that contain it: only then is its number of copies known.
  scene.shown = 1;
  for (auto node = children_first_.rbegin(); node != children_first_.rend(); ++node) choose(**node, storage);
  check_counts(scene);
}

void GroupPlan::fail(const toml::node& at, std::string message) {
  log_.error(reading::position_of(at.source()), std::move(message));
  sound_ = false;
}

GroupPlan::Node& GroupPlan::node_of(const toml::table& table) {
  const auto [entry, fresh] = by_table_.try_emplace(&table, nullptr);
  if (fresh) {
    entry->second = &nodes_.emplace_back();
    entry->second->table = &table;
    entry->second->counters = counter_names(table);
  }
  return *entry->second;
}

bool GroupPlan::is_pattern(const toml::table& group) {
  return group["pattern"].value_or(false);
}

void GroupPlan::enter_names(const toml::table& root) {
  for (const toml::table* table : tables(root, "group")) {
    const toml::table& group = *table;
    const auto* name = group["name"].as_string();
    if (name && !name->get().empty()) {
      Node& node = node_of(group);
      node.name = name->get();
      const auto [entry, fresh] = by_name_.try_emplace(name->get(), &node);
      // Groups may share a name that no instance uses.
      if (!fresh) shared_names_.insert(name->get());
    } else if (is_pattern(group)) {
      log_.error(reading::position_of(group.get("pattern")->source()),
                 "a pattern needs a `name`, by which an [[instance]] refers to it");
    }
  }
}

// Finds the node's members.
void GroupPlan::link(Node& node) {
  for (const std::string_view name : placed_names()) {
    const Section& section = *find_section(name);
    for (const toml::table* each : tables(*node.table, name)) {
      const toml::table& table = *each;
      switch (section.kind) {
        case Section::Kind::instance:
          link_instances(node, table);
          break;
        case Section::Kind::group:
          if (!is_pattern(table)) {
            Node& inner = node_of(table);
            inner.counters.insert(inner.counters.end(), node.counters.begin(), node.counters.end());
            node.members.push_back({&inner, copies(table)});
          } else if (!node.is_scene)
            log_.error(reading::position_of(table.get("pattern")->source()),
                       "only a [[group]] that is in no other can be a pattern");
          break;
        default:
          node.own += section.is_combined() ? count_shapes(table) : copies(table);
          node.bounded = node.bounded && (!section.shape || section.shape->bounded);
      }
    }
  }
}

// Adds the groups that an [[instance]] shows to the node's members. It names them by its key, or in its
// batch.
void GroupPlan::link_instances(Node& node, const toml::table& table) {
  const auto add = [&](const toml::node& name, double count) {
    const auto found = name.is_string() ? by_name_.find(name.as_string()->get()) : by_name_.end();
    if (name.is_string() && shared_names_.contains(name.as_string()->get()))
      log_.error(reading::position_of(name.source()),
                 fmt::format("more than one [[group]] is named \"{}\"", name.as_string()->get()));
    if (found != by_name_.end())
      node.members.push_back({found->second, count * copies(*found->second->table)});
  };
  if (const toml::node* name = table.get("group")) return add(*name, copies(table));
  if (const toml::array* names = table[batch_key]["group"].as_array())
    for (const toml::node& name : *names) add(name, 1);
}

// Adds the totals of the node's groups to those of the node.
void GroupPlan::visit(Node& node, std::vector<std::string_view>& chain) {
  if (node.visit == Node::Visit::done) return;
  chain.push_back(node.name);
  if (node.visit == Node::Visit::begun) {
    std::vector<std::string_view> circle(std::ranges::find(chain, node.name), chain.end());
    std::erase(circle, "");
    fail(*node.table->get("name"),
         fmt::format("group \"{}\" contains itself: {}", node.name, fmt::join(circle, " → ")));
  } else if (chain.size() > deepest) {
    fail(*node.table, fmt::format("groups are nested more than {} deep", deepest));
  } else {
    node.visit = Node::Visit::begun;
    link(node);
    node.items = node.objects = node.own;
    for (const auto& [group, count] : node.members) {
      if (!sound_) break;
      visit(*group, chain);
      node.items += count * group->items;
      node.objects += count * (group->objects + 1);
      node.bounded = node.bounded && group->bounded;
      node.height = std::max(node.height, group->height + 1);
    }
    if (sound_ && node.height > deepest)
      fail(*node.table, fmt::format("groups are nested more than {} deep", deepest));
    node.visit = Node::Visit::done;
    children_first_.push_back(&node);
  }
  chain.pop_back();
}

void GroupPlan::choose(Node& node, GroupStorage storage) {
  // Compare the node's cost if it is instanced with its least cost if its groups may be instanced instead.
  const double once = node.items + instance_cost * node.shown;
  double apart = node.own * node.shown;
  for (const auto& [group, count] : node.members) {
    const double shown = count * node.shown;
    apart += std::min(shown * group->items, group->items + instance_cost * shown);
  }
  const bool possible =
      node.bounded && node.shown >= 2 && node.items > 0 && !contents_mention(*node.table, node.counters);
  const bool worthwhile = once <= apart && node.shown * node.items - once >= worth_keeping_once;
  node.instanced =
      possible && (storage == GroupStorage::instanced || (storage == GroupStorage::automatic && worthwhile));
  if (node.instanced) return;
  for (const auto& [group, count] : node.members) group->shown += count * node.shown;
}

void GroupPlan::check_counts(const Node& root) {
  double kept = 0;
  for (const Node& node : nodes_)
    kept += node.instanced ? node.objects + node.shown : (node.own + 1) * node.shown;
  for (const toml::table* group : idle()) kept += by_table_.at(group)->objects;
  if (root.items > most_shown) {
    sound_ = false;
    log_.error({}, fmt::format("batches and groups show {:.0f} objects; at most {:.0f} can have ids",
                               root.items, most_shown));
  } else if (kept > most_kept) {
    sound_ = false;
    log_.error({}, fmt::format("batches and groups make {:.0f} objects; at most {:.0f} are possible", kept,
                               most_kept));
  }
}

bool GroupPlan::is_instanced(const toml::table& group) const {
  return by_table_.at(&group)->instanced;
}

const toml::table* GroupPlan::find(std::string_view name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? nullptr : found->second->table;
}

std::vector<std::string_view> GroupPlan::names() const {
  std::vector<std::string_view> names;
  for (const auto& [name, node] : by_name_) names.push_back(name);
  return names;
}

std::vector<const toml::table*> GroupPlan::idle() const {
  std::vector<const toml::table*> idle;
  for (const auto& [name, node] : by_name_)
    if (node->idle) idle.push_back(node->table);
  return idle;
}

}  // namespace eyeray::engine::loader
