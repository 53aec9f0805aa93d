#include "host/compute/contents.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/compute/data_file.hpp"
#include "host/reading/source_position.hpp"

namespace eyeray::engine::compute {
namespace {

uint64_t mix(uint64_t z) {
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
  z = (z ^ z >> 27) * 0x94d049bb133111eb;
  return z ^ z >> 31;
}

std::string title_of(const BufferSlot& slot) {
  return fmt::format("[{}.{}]", is_image(*slot.type) ? "image" : "buffer", slot.name);
}

bool is_normalised(const emulator::Format& format) {
  return format.kind == emulator::Format::Kind::unorm || format.kind == emulator::Format::Kind::snorm;
}

// True if a kernel sees the texels of both formats as numbers of the same kind.
bool are_alike(const emulator::Format& a, const emulator::Format& b) {
  const auto seen = [](const emulator::Format& format) {
    return is_normalised(format) ? emulator::Format::Kind::real : format.kind;
  };
  return seen(a) == seen(b);
}

// Reads the contents of one buffer or image.
class BufferReader {
 public:
  BufferReader(const BufferSlot& slot, uint64_t seed, const toml::table& table, const Document& document,
               DiagnosticLog& log)
      : slot_(slot),
        seed_(seed),
        table_(table),
        document_(document),
        log_(log),
        title_(title_of(slot)),
        keys_(read_keys(is_image(*slot.type) ? Table::image : Table::buffer, title_, table, log)) {}

  JobBuffer read(const std::array<uint64_t, 3>& invocations) {
    JobBuffer buffer{.slot = slot_, .type = slot_.type, .bytes = {}};
    buffer.compared = keys_.boolean("compare");
    buffer.width = invocations[0];
    if (is_image(*slot_.type))
      read_image_keys(buffer);
    else if (keys_.has("width"))
      buffer.width = uint64_t(keys_.integer("width"));
    const toml::node* contents = nullptr;
    for (const std::string_view key : {"file", "values", "fill", "noise"}) {
      const toml::node* const node = table_.get(key);
      if (node && contents) fail(*node, fmt::format("{} has contents already: leave out `{}`", title_, key));
      if (node && !contents) contents = node;
    }
    if (keys_.failed()) return buffer;
    if (contents && contents == table_.get("file")) {
      read_file(*contents, invocations, buffer);
    } else {
      set_size(contents, invocations, buffer);
      write_contents(contents, buffer);
    }
    if (is_image(*buffer.type)) buffer.width = buffer.type->extent[0];
    if (keys_.has("output")) buffer.output = path_at(document_, *table_.get("output"));
    return buffer;
  }

 private:
  void fail(const toml::node& node, const std::string& message) {
    log_.error(reading::position_of(node.source()), message);
  }

  // Reads `format` and `size`.
  void read_image_keys(JobBuffer& buffer) {
    const uint32_t axes = slot_.image.coordinates();
    if (keys_.has("format")) {
      const gpu::TexelFormat* const format = gpu::find_format(keys_.string("format"));
      const gpu::TexelFormat& usual = *gpu::find_format(slot_.type->name);
      if (!format)
        keys_.error("format", fmt::format("`format` must be one of {}", gpu::format_names()));
      else if (slot_.image.format && format != slot_.image.format)
        keys_.error("format", fmt::format("the kernel declares '{}' as {}", slot_.name, usual.name));
      else if (!are_alike(format->numbers, usual.numbers))
        keys_.error("format", fmt::format("the kernel reads the numbers of '{}' as those of {}", slot_.name,
                                          usual.name));
      else
        buffer.type = image_type(*format, axes);
    }
    const auto size = sizes_at(table_, "size", log_);
    if (!size) return;
    const toml::array* const list = table_.get("size")->as_array();
    if ((list ? list->size() : 1) != axes)
      return fail(*table_.get("size"),
                  fmt::format("`size` must be {} whole number{}, since '{}' has as many axes", axes,
                              axes == 1 ? "" : "s", slot_.name));
    set_extent({size->begin(), size->begin() + axes}, table_.get("size"), buffer);
  }

  void set_extent(const std::vector<uint64_t>& extent, const toml::node* node, JobBuffer& buffer) {
    try {
      buffer.type = with_extent(*buffer.type, extent);
    } catch (const Error& error) {
      fail(node ? *node : table_, fmt::format("'{}': {}", slot_.name, error.what()));
    }
  }

  void read_file(const toml::node& file, const std::array<uint64_t, 3>& invocations, JobBuffer& buffer) {
    try {
      const std::filesystem::path path = path_at(document_, file);
      if (is_image(*slot_.type) && !decides_extent(path, *buffer.type))
        set_size(&file, invocations, buffer);
      else if (const auto elements = declared_elements())
        buffer.type = sized(slot_, *elements);
      buffer.bytes = read_block(path, buffer.type);
    } catch (const Error& error) {
      fail(file, error.what());
    }
  }

  // The elements that the table states by `elements` or `bytes`.
  std::optional<uint64_t> declared_elements() {
    if (is_image(*slot_.type)) return std::nullopt;
    const bool counted = keys_.has("elements");
    if (!counted && !keys_.has("bytes")) return std::nullopt;
    const std::string_view key = counted ? "elements" : "bytes";
    const Member* const array = run_time_array(*slot_.type);
    const auto value = uint64_t(keys_.integer(key));
    if (!array) {
      if (counted || value != size(*slot_.type))
        keys_.error(key, fmt::format("'{}' has {} bytes, since it has no run-time array", slot_.name,
                                     size(*slot_.type)));
      return std::nullopt;
    }
    if (counted) return value;
    if (value <= array->offset || (value - array->offset) % array->type->stride != 0) {
      keys_.error(key, fmt::format("'{}' has {} bytes and {} for each element", slot_.name, array->offset,
                                   array->type->stride));
      return std::nullopt;
    }
    return (value - array->offset) / array->type->stride;
  }

  void set_size(const toml::node* contents, const std::array<uint64_t, 3>& invocations, JobBuffer& buffer) {
    if (is_image(*slot_.type)) {
      if (buffer.type->count == 0)
        set_extent({invocations.begin(), invocations.begin() + slot_.image.coordinates()}, contents, buffer);
      buffer.bytes.resize(size(*buffer.type));
      return;
    }
    uint64_t all = 1;
    for (const uint64_t along : invocations) all = along > UINT64_MAX / all ? UINT64_MAX : all * along;
    std::optional<uint64_t> elements = declared_elements();
    if (!elements && contents && contents == table_.get("values"))
      elements = elements_in(*contents, *slot_.type);
    try {
      buffer.type = sized(slot_, elements.value_or(all));
      buffer.bytes.resize(size(*buffer.type));
    } catch (const Error& error) {
      if (contents)
        fail(*contents, error.what());
      else
        log_.error(reading::position_of(table_.source()), error.what());
    }
  }

  void write_contents(const toml::node* contents, JobBuffer& buffer) {
    if (buffer.bytes.empty()) return;
    const gpu::TexelFormat* const format = gpu::find_format(buffer.type->name);
    Noise usual{.seed = seed_};
    if (is_image(*buffer.type) && is_normalised(format->numbers))
      usual.to = (1 << (format->numbers.bits - (format->numbers.kind == emulator::Format::Kind::snorm))) - 1;
    if (!contents) {
      if (slot_.kind != gpu::BindingKind::uniform && slot_.readable)
        fill_with_noise(usual, *buffer.type, buffer.bytes);
      return;
    }
    if (contents == table_.get("values")) {
      assign(*contents, *buffer.type, buffer.bytes, log_);
    } else if (contents == table_.get("fill")) {
      bool held = true;
      for_each_number(*buffer.type, 0, [&](const Number& number, uint64_t offset) {
        held = held && write_number(number, keys_.number("fill"), buffer.bytes.data() + offset);
      });
      if (!held) fail(*contents, fmt::format("'{}' has numbers that do not hold this value", slot_.name));
    } else if (const toml::table* noise = table_at(table_, "noise", log_)) {
      const reading::TableReader keys = read_keys(Table::noise, "noise", *noise, log_);
      if (keys.failed()) return;
      Noise how = usual;
      how.from = keys.number("from");
      if (keys.has("seed")) how.seed = uint64_t(keys.integer("seed"));
      if (keys.has("to")) how.to = keys.number("to");
      if (!fill_with_noise(how, *buffer.type, buffer.bytes))
        fail(*contents, fmt::format("'{}' has numbers that do not hold this range", slot_.name));
    }
  }

  const BufferSlot& slot_;
  uint64_t seed_;
  const toml::table& table_;
  const Document& document_;
  DiagnosticLog& log_;
  std::string title_;
  reading::TableReader keys_;
};

}  // namespace

bool fill_with_noise(const Noise& noise, const Type& type, std::span<std::byte> bytes) {
  uint64_t i = 0;
  bool held = true;
  for_each_number(type, 0, [&](const Number& number, uint64_t offset) {
    const uint64_t bits = mix(noise.seed + ++i * 0x9e3779b97f4a7c15);
    const double share = double(bits >> 40) * 0x1p-24;
    const bool real = number.kind == NumberKind::real;
    const double to = noise.to.value_or(noise.from + (real ? 1 : 7));
    const double value = real ? noise.from + (to - noise.from) * share
                              : noise.from + std::floor((to - noise.from + 1) * share);
    held = held && to >= noise.from && write_number(number, value, bytes.data() + offset);
  });
  return held;
}

TypePtr sized(const BufferSlot& slot, uint64_t elements) {
  const Member* const array = run_time_array(*slot.type);
  const uint64_t each = array ? std::max<uint64_t>(array->type->stride, 1) : 1;
  if (size(*slot.type) > most_bytes || (array && elements > most_bytes / each))
    throw Error(ExitCode::bad_input,
                "buffer '{}' would have more than {} bytes, the most that eyeray runs with", slot.name,
                most_bytes);
  return with_elements(slot.type, elements);
}

JobBuffer read_buffer(const BufferSlot& slot, uint64_t seed, const toml::table* table,
                      const Document& document, const std::array<uint64_t, 3>& invocations,
                      DiagnosticLog& log) {
  const toml::table none;
  return BufferReader(slot, seed, table ? *table : none, document, log).read(invocations);
}

}  // namespace eyeray::engine::compute
