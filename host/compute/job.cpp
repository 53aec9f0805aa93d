#include "host/compute/job.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/compute/contents.hpp"
#include "host/compute/data_file.hpp"
#include "host/compute/module.hpp"
#include "host/compute/source.hpp"
#include "host/emulator/emulator.hpp"
#include "host/reading/source_position.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::compute {
namespace {

SourcePosition position(const toml::node& node) {
  return reading::position_of(node.source());
}

// The buffer or image of a name. Error (bad_input) if there is none.
size_t index_of(const Job& job, std::string_view name) {
  std::vector<std::string> names;
  for (size_t i = 0; i < job.buffers.size(); ++i) {
    const BufferSlot& slot = job.buffers[i].slot;
    if (name == slot.name || name == slot.variable || name == fmt::format("{}.{}", slot.set, slot.binding))
      return i;
    names.push_back(slot.name);
  }
  throw Error(ExitCode::bad_input, "the kernel has no buffer or image `{}`{}", name, suggest(name, names));
}

// Makes a job of the table that names its kernel: the kernel file's root, or its [same].
class JobMaker {
 public:
  // `model`: the job that this one is to equal, which decides the contents; or null.
  JobMaker(Table kind, const toml::table& table, const Document& document, const Job* model,
           DiagnosticLog& log)
      : table_(table),
        document_(document),
        model_(model),
        log_(log),
        keys_(read_keys(kind, kernel_table(kind).title, table, log)) {}

  Job make() {
    if (log_.has_errors()) throw_errors();
    job_.file = document_.file.string();
    const KernelSource source = kernel_source();
    job_.kernel = source.file.lexically_normal().string();
    LoadedKernel kernel = load_kernel(source);
    job_.warnings = std::move(kernel.warnings);
    job_.ulp = uint64_t(keys_.integer("ulp"));
    kernel.spirv = specialised(kernel.spirv);
    const Interface interface = interface_of(kernel.spirv);
    job_.local_size = interface.local_size;
    job_.spirv = in_one_set(kernel.spirv, interface);
    // Filtered reads are refused at their line.
    if (std::ranges::any_of(interface.buffers, [](const BufferSlot& slot) { return slot.image.sampled; }))
      emulator::Kernel(job_.spirv, job_.kernel);
    set_groups();
    read_buffers(interface);
    read_push(interface);
    return std::move(job_);
  }

  // Reads the checks of verify: [expect] and [same].
  void read_checks(Job& job);

 private:
  [[noreturn]] void throw_errors() { throw InputError(log_.sorted()); }

  KernelSource kernel_source() {
    KernelSource source{.file = path_at(document_, *table_.get("kernel")), .entry = keys_.string("entry")};
    for (const toml::node* define : strings_at(table_, "defines", log_))
      source.defines.push_back(define->value_or(std::string()));
    for (const toml::node* folder : strings_at(table_, "include_folders", log_))
      source.include_folders.push_back(path_at(document_, *folder));
    return source;
  }

  std::vector<uint32_t> specialised(const std::vector<uint32_t>& spirv);
  void set_groups();
  void read_buffers(const Interface& interface);
  void read_push(const Interface& interface);
  void adopt(JobBuffer& buffer) const;
  void warn_of_zeros(const std::string& what, const std::string& key);
  // The table of each buffer in [buffer], or of each image in [image].
  void find_tables(std::string_view kind, std::vector<const toml::table*>& tables);
  std::optional<size_t> find_buffer(const toml::key& key, const Job& job);

  const toml::table& table_;
  const Document& document_;
  const Job* model_;
  DiagnosticLog& log_;
  reading::TableReader keys_;
  Job job_;
};

std::vector<uint32_t> JobMaker::specialised(const std::vector<uint32_t>& spirv) {
  const std::vector<SpecConstant> constants = spec_constants(spirv);
  std::vector<std::string> names;
  for (const SpecConstant& each : constants)
    names.push_back(each.name.empty() ? std::to_string(each.id) : each.name);
  std::map<uint32_t, uint64_t> bits;
  if (const toml::table* table = table_at(document_.root, "constants", log_))
    for (const auto& [key, value] : *table) {
      const std::string_view name = key.str();
      const auto found = std::ranges::find_if(constants, [&](const SpecConstant& each) {
        return each.name == name || std::to_string(each.id) == name;
      });
      if (found == constants.end()) {
        if (!model_)
          log_.error(
              reading::position_of(key.source()),
              fmt::format("the kernel has no specialization constant `{}`{}", name, suggest(name, names)));
        continue;
      }
      uint64_t word = 0;
      const Type type{.number = found->number};
      if (assign(value, type, std::as_writable_bytes(std::span(&word, 1)), log_)) bits[found->id] = word;
    }
  if (log_.has_errors()) throw_errors();
  return specialise(spirv, bits);
}

void JobMaker::set_groups() {
  const auto groups = sizes_at(table_, "groups", log_);
  const auto invocations = sizes_at(table_, "invocations", log_);
  if (groups && invocations)
    log_.error(position(*table_.get("invocations")), "`groups` is given already: leave out `invocations`");
  if (groups) job_.groups = *groups;
  if (!groups && !invocations && model_) {
    // As many invocations as the other kernel.
    for (size_t axis = 0; axis < 3; ++axis) {
      const uint64_t wanted = uint64_t{model_->groups[axis]} * model_->local_size[axis];
      job_.groups[axis] = uint32_t((wanted + job_.local_size[axis] - 1) / job_.local_size[axis]);
    }
  }
  if (!invocations) return;
  for (size_t axis = 0; axis < 3; ++axis)
    job_.groups[axis] = ((*invocations)[axis] - 1) / job_.local_size[axis] + 1;
}

std::optional<size_t> JobMaker::find_buffer(const toml::key& key, const Job& job) {
  try {
    return index_of(job, key.str());
  } catch (const Error& error) {
    log_.error(reading::position_of(key.source()), error.what());
    return std::nullopt;
  }
}

void JobMaker::find_tables(std::string_view kind, std::vector<const toml::table*>& tables) {
  const toml::table* const all = table_at(document_.root, kind, log_);
  if (!all || model_) return;
  for (const auto& [key, value] : *all) {
    const auto index = find_buffer(key, job_);
    if (!index) continue;
    const std::string_view right = is_image(*job_.buffers[*index].type) ? "image" : "buffer";
    if (!value.is_table() || right != kind)
      log_.error(position(value), fmt::format("write [{}.{}], a table", right, key.str()));
    else
      tables[*index] = value.as_table();
  }
}

// Gives a buffer the contents of the other kernel's buffer of its name.
void JobMaker::adopt(JobBuffer& buffer) const {
  for (const JobBuffer& other : model_->buffers) {
    if (other.slot.name != buffer.slot.name) continue;
    if (is_image(*buffer.type) && is_image(*other.type))
      buffer.type = buffer.slot.image.format ? with_extent(*buffer.type, other.type->extent) : other.type;
    const Member* const array = run_time_array(*other.slot.type);
    if (array && run_time_array(*buffer.slot.type))
      buffer.type = sized(buffer.slot, other.type->members.back().type->count);
    buffer.bytes = other.bytes;
    if (size(*buffer.type) != size(*other.type))
      throw Error(ExitCode::bad_input, "buffer '{}' has {} bytes in {}, but {} in {}", buffer.slot.name,
                  size(*buffer.type), job_.kernel, size(*other.type), model_->kernel);
    return;
  }
}

void JobMaker::read_buffers(const Interface& interface) {
  for (const BufferSlot& slot : interface.buffers)
    job_.buffers.push_back({.slot = slot, .type = slot.type, .bytes = {}});
  std::vector<const toml::table*> tables(job_.buffers.size());
  find_tables("buffer", tables);
  find_tables("image", tables);
  std::array<uint64_t, 3> invocations{};
  for (size_t axis = 0; axis < 3; ++axis)
    invocations[axis] = uint64_t{job_.groups[axis]} * job_.local_size[axis];
  for (size_t i = 0; i < job_.buffers.size(); ++i) {
    JobBuffer& buffer = job_.buffers[i];
    buffer = read_buffer(buffer.slot, i + 1, tables[i], document_, invocations, log_);
    if (model_) adopt(buffer);
    const bool given = tables[i] && (tables[i]->contains("values") || tables[i]->contains("fill") ||
                                     tables[i]->contains("noise") || tables[i]->contains("file"));
    if (buffer.slot.kind == gpu::BindingKind::uniform && !given && !model_)
      warn_of_zeros(fmt::format("all numbers of the uniform buffer '{}' are 0", buffer.slot.name),
                    fmt::format("buffer.{}.values", buffer.slot.name));
    if (buffer.output.empty()) continue;
    try {
      check_output(buffer.output, *buffer.type, buffer.width);
    } catch (const Error& error) {
      log_.error(position(*tables[i]->get("output")), error.what());
    }
  }
}

void JobMaker::warn_of_zeros(const std::string& what, const std::string& key) {
  job_.warnings.push_back(
      {Severity::warning, {job_.file, 0, 0}, fmt::format("{}, since {} is not set", what, key), ""});
}

void JobMaker::read_push(const Interface& interface) {
  const toml::table* const table = table_at(document_.root, "push", log_);
  if (!interface.push) {
    if (table && !model_) log_.error(position(*table), "the kernel has no push constants");
    return;
  }
  job_.push.resize((size(*interface.push) + 3) / 4 * 4);
  std::string missing;
  for (const Member& member : interface.push->members) {
    const toml::node* const value = table ? table->get(member.name) : nullptr;
    if (!value) missing += (missing.empty() ? "" : ", ") + member.name;
    if (value && model_) assign(*value, *member.type, std::span(job_.push).subspan(member.offset), log_);
  }
  if (model_) return;
  if (table) assign(*table, *interface.push, job_.push, log_);
  if (!missing.empty()) warn_of_zeros("the push constants are 0: " + missing, "[push]");
}

void JobMaker::read_checks(Job& job) {
  if (const toml::table* all = table_at(table_, "expect", log_))
    for (const auto& [key, value] : *all) {
      const auto index = find_buffer(key, job);
      const toml::table* const table = value.as_table();
      const std::string title = fmt::format("[expect.{}]", key.str());
      if (!table) log_.error(position(value), fmt::format("write {}, a table", title));
      if (!table || !index) continue;
      const reading::TableReader keys = read_keys(Table::expect, title, *table, log_);
      if (keys.failed()) continue;
      const fs::path file = path_at(document_, *table->get("file"));
      TypePtr type = job.buffers[*index].type;
      try {
        job.expected.push_back({.buffer = *index,
                                .file = file.string(),
                                .bytes = read_block(file, type),
                                .ulp = uint64_t(keys.integer("ulp")),
                                .absolute = keys.number("absolute")});
      } catch (const Error& error) {
        log_.error(position(*table->get("file")), error.what());
      }
    }
  const toml::table* const same = table_at(table_, "same", log_);
  if (log_.has_errors()) throw_errors();
  if (!same) return;
  JobMaker maker(Table::same, *same, document_, &job, log_);
  SameAs made{.job = std::make_shared<Job>(maker.make()), .ulp = 0, .buffers = {}};
  made.ulp = made.job->ulp;
  for (size_t i = 0; i < job.buffers.size(); ++i)
    for (size_t other = 0; other < made.job->buffers.size(); ++other)
      if (job.buffers[i].slot.name == made.job->buffers[other].slot.name && job.buffers[i].slot.writable &&
          job.buffers[i].compared)
        made.buffers.emplace_back(i, other);
  if (made.buffers.empty())
    log_.error(position(*same),
               "the two kernels write no buffer of the same name, so nothing can be compared");
  job.same = std::move(made);
}

}  // namespace

std::string describe_dispatch(const Job& job) {
  const auto& [groups, local] = std::tie(job.groups, job.local_size);
  return fmt::format("{}×{}×{} work group{} of {}×{}×{} invocations", groups[0], groups[1], groups[2],
                     groups[0] == 1 && groups[1] == 1 && groups[2] == 1 ? "" : "s", local[0], local[1],
                     local[2]);
}

bool is_job(const fs::path& file) {
  if (is_kernel_source(file)) return true;
  if (file.extension() != ".toml") return false;
  try {
    DiagnosticLog log;
    const Document document = read_document(file, log);
    return document.root.contains("kernel");
  } catch (const Error&) {
    return false;
  }
}

void set_output(Job& job, const std::string& name, const fs::path& file) {
  JobBuffer& buffer = job.buffers[index_of(job, name)];
  check_output(file, *buffer.type, buffer.width);
  buffer.output = file;
}

Job load_job(const std::string& file, const std::vector<std::string>& overrides) {
  DiagnosticLog log;
  Document document;
  if (is_kernel_source(file)) {
    log.add_source(file, "");
    document.file = file;
    document.root.insert_or_assign("kernel", file);
  } else {
    document = read_document(file, log);
  }
  apply_overrides(document, overrides, log);
  JobMaker maker(Table::top, document.root, document, nullptr, log);
  Job job = maker.make();
  maker.read_checks(job);
  if (log.has_errors()) throw InputError(log.sorted());
  return job;
}

}  // namespace eyeray::engine::compute
