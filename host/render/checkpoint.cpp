#include "host/render/checkpoint.hpp"

#include <fmt/ranges.h>
#include <array>
#include <bit>

#include "host/core/atomic_file.hpp"
#include "host/core/checksum.hpp"
#include "host/core/error.hpp"
#include "host/core/escaped_text.hpp"

namespace eyeray::engine::render {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");
static_assert(sizeof(RenderPosition) == 48, "the file holds it as it lies in memory");

constexpr std::string_view magic = "EYERAYCP";
constexpr uint32_t version = 7;
constexpr uint32_t longest_identity = 65536;

std::filesystem::path rows_of(const std::filesystem::path& file) {
  return file.string() + ".rows";
}

template <typename Value>
std::string raw(const Value& value) {
  return std::string(reinterpret_cast<const char*>(&value), sizeof value);
}

uint32_t crc32_of(std::string_view text) {
  return crc32(std::as_bytes(std::span(text)));
}

std::string as_text(const std::vector<IdentityPart>& identity) {
  std::string text;
  for (const IdentityPart& part : identity) text += fmt::format("{}: {}\n", part.name, part.value);
  return text;
}

// The value of the part `name` in `text`; empty if the text lacks the part.
std::string_view value_in(std::string_view text, const std::string& name) {
  const std::string begin = name + ": ";
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    if (line.starts_with(begin)) return line.substr(begin.size());
    text.remove_prefix(std::min(line.size() + 1, text.size()));
  }
  return {};
}

}  // namespace

Checkpoint::Checkpoint(std::filesystem::path file, std::vector<IdentityPart> identity, double seconds)
    : file_(std::move(file)),
      identity_(std::move(identity)),
      seconds_(seconds),
      rows_(std::make_unique<film::RowStore>(rows_of(file_))) {}

Checkpoint Checkpoint::begin(std::filesystem::path file, std::vector<IdentityPart> identity, double seconds) {
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored))
    throw Error(ExitCode::bad_input,
                "the checkpoint {} exists already: continue from it with --resume {}, or remove it",
                file.string(), shell_word(file.string()));
  check_writable(file);
  check_writable(rows_of(file));
  return {std::move(file), std::move(identity), seconds};
}

Checkpoint Checkpoint::resume(std::filesystem::path file, std::vector<IdentityPart> identity,
                              double seconds) {
  Checkpoint checkpoint(std::move(file), std::move(identity), seconds);
  checkpoint.read_header();
  return checkpoint;
}

void Checkpoint::damaged(const std::string& why) const {
  throw Error(ExitCode::cannot_resume, "cannot resume from {}: {}", file_.string(), why);
}

// Reads the next value of the file, and adds its bytes to `checksum`.
template <typename Value>
Value Checkpoint::take(uint32_t& checksum) {
  Value value{};
  if (!input_->read(reinterpret_cast<char*>(&value), sizeof value)) damaged("it ends too early");
  checksum = crc32(std::as_bytes(std::span(&value, 1)), checksum);
  return value;
}

void Checkpoint::read_header() {
  std::error_code error;
  input_bytes_ = std::filesystem::file_size(file_, error);
  if (error) damaged(error.message());
  input_ = std::make_unique<std::ifstream>(file_, std::ios::binary);
  if (!*input_) damaged("it cannot be opened");

  uint32_t checksum = 0;
  const auto begin = take<std::array<char, 8>>(checksum);
  if (std::string_view(begin.data(), begin.size()) != magic) damaged("it is not a checkpoint");
  if (const auto its = take<uint32_t>(checksum); its != version)
    damaged(fmt::format("its layout has version {}, but this eyeray's has {}", its, version));
  const auto length = take<uint32_t>(checksum);
  if (length > longest_identity || length > input_bytes_) damaged("it is damaged");
  std::string text(length, '\0');
  if (!input_->read(text.data(), std::streamsize(length))) damaged("it ends too early");
  checksum = crc32(std::as_bytes(std::span(text)), checksum);
  position_ = take<RenderPosition>(checksum);
  rows_checksum_ = take<uint32_t>(checksum);
  const uint32_t sum = checksum;
  if (take<uint32_t>(checksum) != sum) damaged("it is damaged: its checksum is wrong");

  // Now that the header is known to be undamaged, check that the checkpoint is of this render.
  std::vector<std::string> differences;
  for (const IdentityPart& part : identity_) {
    const std::string_view value = value_in(text, part.name);
    if (value == part.value) continue;
    differences.push_back(part.shown ? fmt::format("the {} ({}, now {})", part.name, value, part.value)
                                     : "the " + part.name);
  }
  if (!differences.empty())
    throw Error(ExitCode::cannot_resume,
                "cannot resume from {}: it was made with other options or files; these differ: {}",
                file_.string(), fmt::join(differences, ", "));
}

void Checkpoint::read_sums(film::Film& film) {
  uint64_t end = uint64_t(input_->tellg()) + sizeof(uint32_t);
  for (const std::span<std::byte> bytes : film.parts()) end += bytes.size();
  if (input_bytes_ < end) damaged("it ends too early");
  if (input_bytes_ > end) damaged("it has data after its end");
  uint32_t checksum = 0, ignored = 0;
  for (const std::span<std::byte> bytes : film.parts()) {
    if (!input_->read(reinterpret_cast<char*>(bytes.data()), std::streamsize(bytes.size())))
      damaged("it ends too early");
    checksum = crc32(bytes, checksum);
  }
  if (take<uint32_t>(ignored) != checksum) damaged("it is damaged: its checksum is wrong");
}

film::Rows Checkpoint::read_rows(int first, int count, int width, const film::Channels& channels) {
  try {
    return rows_->read(first, count, width, channels);
  } catch (const Error& error) {
    damaged(error.what());
  }
}

void Checkpoint::check_rows() const {
  if (rows_->checksum() != rows_checksum_)
    damaged(fmt::format("{} is damaged: its checksum is wrong", rows_of(file_).string()));
}

void Checkpoint::append_rows(const film::Rows& rows) {
  if (!failure_.empty()) return;
  try {
    rows_->append(rows);
  } catch (const Error& error) {
    failure_ = error.what();
  }
}

void Checkpoint::save(const RenderPosition& position, const film::Film& film) {
  if (!failure_.empty()) return;
  try {
    rows_->sync();
    const std::string identity = as_text(identity_);
    CHECK_LE(identity.size(), longest_identity);
    std::string header(magic);
    header += raw(version);
    header += raw(uint32_t(identity.size()));
    header += identity;
    header += raw(position);
    header += raw(rows_->checksum());
    header += raw(crc32_of(header));
    AtomicFile file(file_);
    file.write(header);
    uint32_t checksum = 0;
    for (const std::span<const std::byte> bytes : film.parts()) {
      file.write(bytes);
      checksum = crc32(bytes, checksum);
    }
    file.write(raw(checksum));
    file.commit();
    saved_ = true;
  } catch (const Error& error) {
    failure_ = error.what();
  }
  since_saved_ = {};
}

void Checkpoint::remove() {
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
  rows_->remove();
}

}  // namespace eyeray::engine::render
