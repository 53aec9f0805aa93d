#include "host/shards/part_set.hpp"

#include <fmt/ranges.h>
#include <sys/resource.h>

#include <algorithm>
#include <map>
#include <optional>
#include <thread>

#include "host/core/error.hpp"
#include "host/core/parallel_for.hpp"
#include "host/core/termination.hpp"

namespace eyeray::engine::shards {
namespace {

// Limit on the files that a message names for each fault.
constexpr size_t named = 8;

std::string some_of(const std::vector<std::string>& sentences) {
  const std::vector<std::string> first(sentences.begin(),
                                       sentences.begin() + std::ptrdiff_t(std::min(named, sentences.size())));
  const size_t more = sentences.size() - first.size();
  return fmt::format("{}{}", fmt::join(first, "; "), more ? fmt::format("; and {} more", more) : "");
}

// "2/8, 5/8 to 7/8".
std::string ranges(const std::vector<int>& indices, int count) {
  std::vector<std::string> texts;
  for (size_t i = 0; i < indices.size();) {
    size_t last = i;
    while (last + 1 < indices.size() && indices[last + 1] == indices[last] + 1) ++last;
    const std::string first_text = shard_text({indices[i], count}),
                      last_text = shard_text({indices[last], count});
    texts.push_back(last == i ? first_text : first_text + " to " + last_text);
    i = last + 1;
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

// Raises this process's limit on open files as far as the system allows, since all files are open at once.
void allow_open_files() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
}

// The identity that parts of one picture share.
std::string picture_of(const PartHeader& header) {
  PartHeader common = header;
  common.shard.index = 0;
  common.device.clear();
  return to_text(common);
}

// The differences of `header` from `wanted`, in words.
std::string difference(const PartHeader& header, const PartHeader& wanted) {
  std::vector<std::string> differences;
  if (header.shard.count != wanted.shard.count)
    differences.push_back(
        fmt::format("the number of shards ({}, of most {})", header.shard.count, wanted.shard.count));
  for (const render::IdentityPart& part : wanted.identity) {
    const auto its = std::ranges::find(header.identity, part.name, &render::IdentityPart::name);
    const std::string value = its == header.identity.end() ? "unknown" : its->value;
    if (value == part.value) continue;
    differences.push_back(part.shown ? fmt::format("the {} ({}, of most {})", part.name, value, part.value)
                                     : "the " + part.name);
  }
  // All other facts follow from the scene and the options.
  if (differences.empty()) differences.push_back("its scene's file or the program");
  return fmt::format("{}", fmt::join(differences, ", "));
}

}  // namespace

std::string PartFaults::text() const {
  std::vector<std::string> sentences;
  for (const std::vector<std::string>* each : {&damaged, &foreign, &doubled})
    if (!each->empty()) sentences.push_back(some_of(*each));
  if (!missing.empty()) sentences.push_back("missing: " + ranges(missing, count));
  return fmt::format("{}", fmt::join(sentences, "; "));
}

void PartFaults::refuse() const {
  if (any())
    throw Error(damaged.empty() ? ExitCode::bad_input : ExitCode::file_io,
                "these parts do not make a whole picture: {}", text());
}

PartSet::PartSet(const std::vector<std::filesystem::path>& files) {
  allow_open_files();
  std::vector<std::optional<PartReader>> opened(files.size());
  std::vector<std::string> reasons(files.size());
  parallel_for(0, int(files.size()), [&](int number) {
    const auto i = size_t(number);
    stop_if_interrupted();
    try {
      PartReader part(files[i]);
      part.check();
      opened[i].emplace(std::move(part));
    } catch (const Error& error) {
      reasons[i] = fmt::format("{}: {}", files[i].string(), error.what());
    }
  });
  std::vector<PartReader> sound;
  for (size_t i = 0; i < files.size(); ++i) {
    if (opened[i])
      sound.push_back(std::move(*opened[i]));
    else
      faults_.damaged.push_back(std::move(reasons[i]));
  }
  keep_most_frequent(std::move(sound));
  if (parts_.empty()) return;
  wanted_ = &parts_[0].header();
  faults_.count = wanted_->shard.count;
  auto part = parts_.begin();
  for (int i = 0; i < faults_.count; ++i) {
    if (part != parts_.end() && part->header().shard.index == i)
      ++part;
    else
      faults_.missing.push_back(i);
  }
}

// Keeps the parts of the picture that most parts belong to; of equally frequent pictures, the one that was
// named first.
void PartSet::keep_most_frequent(std::vector<PartReader> read) {
  std::vector<std::string> pictures;
  for (const PartReader& part : read) pictures.push_back(picture_of(part.header()));
  std::map<std::string_view, size_t> frequency;
  for (const std::string& picture : pictures) ++frequency[picture];
  const auto most =
      std::ranges::max_element(pictures, {}, [&](const std::string& picture) { return frequency[picture]; });
  if (most == pictures.end()) return;

  std::map<int, size_t> by_shard;
  const PartHeader& wanted = read[size_t(most - pictures.begin())].header();
  for (size_t i = 0; i < read.size(); ++i) {
    const std::string name = read[i].file().string();
    const PartHeader& header = read[i].header();
    if (pictures[i] != *most) {
      faults_.foreign.push_back(
          fmt::format("{} is of another picture; these differ: {}", name, difference(header, wanted)));
    } else if (const auto [other, first] = by_shard.try_emplace(header.shard.index, i); !first) {
      faults_.doubled.push_back(fmt::format("{} and {} are both {}", read[other->second].file().string(),
                                            name, shard_text(header.shard)));
    }
  }
  for (const auto& [shard, i] : by_shard) parts_.push_back(std::move(read[i]));
}

PartTotals PartSet::totals() const {
  PartTotals totals = parts_.at(0).totals();
  for (size_t i = 1; i < parts_.size(); ++i) totals.add(parts_[i].totals());
  return totals;
}

void PartSet::merge(const PlaneSink& sink) {
  CHECK(!faults_.any() && wanted_);
  const Rect area = wanted_->area;
  const render::Tiling tiling(area.width, area.height, wanted_->shard.count);
  std::vector<float> pixels;
  // Merge a block of OpenEXR for each core, of up to 8. A block's 16 rows are two rows of tiles.
  const int together = 2 * std::clamp(int(std::thread::hardware_concurrency()), 1, 8) * tiling.columns();
  // One image for each number of channels, used again and again: new memory costs more than the work with it.
  std::map<int, image::Image> images;
  for (int first = 0; first < tiling.count(); first += together) {
    const int end = std::min(first + together, tiling.count());
    const int top = tiling.tile(first).y, height = tiling.tile(end - 1).y + tiling.tile(end - 1).height - top;
    for (size_t plane = 0; plane < wanted_->planes(); ++plane) {
      stop_if_interrupted();
      const int channels = wanted_->channels(plane);
      image::Image& rows = images.try_emplace(channels, area.width, height, channels).first->second;
      if (rows.height() != height) rows = image::Image(area.width, height, channels);
      for (int number = first; number < end; ++number) {
        PartReader& part = parts_[size_t(tiling.owner(number))];
        try {
          part.read_tile(plane, pixels);
        } catch (const Error& error) {
          throw Error(error.code(), "{}: {}", part.file().string(), error.what());
        }
        const Rect tile = tiling.tile(number);
        const size_t width = size_t(tile.width) * size_t(channels);
        for (int y = 0; y < tile.height; ++y)
          std::copy_n(&pixels[size_t(y) * width], width, rows.pixel(tile.x, tile.y - top + y));
      }
      sink(plane, rows);
    }
  }
}

}  // namespace eyeray::engine::shards
