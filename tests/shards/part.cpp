// Files of parts: the written values are read, and every flipped bit is found.
#include <algorithm>

#include "host/core/error.hpp"
#include "host/shards/part_reader.hpp"
#include "host/shards/part_set.hpp"
#include "host/shards/part_writer.hpp"
#include "tests/support/process.hpp"
#include "tests/support/random.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shards;
using namespace eyeray::engine::test;

namespace {

constexpr Rect area{3, 2, 43, 21};

PartHeader header_of_shard(const render::Shard& shard) {
  PartHeader header;
  header.shard = shard;
  header.scene = "scenes/a.toml";
  header.area = area;
  header.samples = 4;
  header.tone = {0.1, image::ToneCurve::neutral};
  header.device = "none";
  header.build = "1234";
  header.aovs = film::parse_channels("depth,normal");
  header.identity = {{"size", "64x48"}, {"scene", "abcd", false}};
  return header;
}

// A value that differs for each channel of each pixel of each plane.
float value_at(size_t plane, int x, int y, int channel) {
  return float(plane) * 1000 + float(x) + float(y) / 64 + float(channel) / 8192;
}

// Writes a part as a render does: the picture as a stack, and the AOVs as tiles, like those of first hits.
std::string write_part(const TemporaryFolder& folder, const PartHeader& header) {
  const render::ShardTiles tiles(header.area, header.shard);
  const std::string file = folder / fmt::format("{}-{}.eyeray", header.shard.index + 1, header.shard.count);
  PartWriter part(file, header, tiles);
  image::Image stack(tiles.width(), tiles.height(), 3);
  std::ranges::fill(stack.samples(), -1.0f);
  for (size_t i = 0; i < tiles.tiles().size(); ++i) {
    const Rect& tile = tiles.tiles()[i];
    for (size_t plane = 0; plane < header.planes(); ++plane) {
      const int channels = header.channels(plane);
      image::Image values(tile.width, tile.height, channels);
      for (int y = 0; y < tile.height; ++y)
        for (int x = 0; x < tile.width; ++x)
          for (int c = 0; c < channels; ++c) {
            const float value = value_at(plane, tile.x + x, tile.y + y, c);
            values.pixel(x, y)[c] = value;
            if (plane == 0) stack.pixel(x, int(i) * render::Tiling::tile_height + y)[c] = value;
          }
      if (plane > 0) part.write_tile(plane, values);
    }
  }
  part.write(0, stack);
  PartTotals totals;
  totals.rays = 1000 + uint64_t(header.shard.index);
  totals.flags = 1u << header.shard.index % 4;
  totals.flagged_pixels = 2;
  totals.flagged_hits = 3;
  totals.clamped = 4;
  totals.ray_kinds.emplace();
  totals.ray_kinds->shadow = 6;
  totals.seconds = 0.5;
  totals.processor_seconds = 1.5;
  totals.brightness.counts()[7] = 5;
  totals.legends.resize(2);
  totals.legends[0].nothing = 9;
  totals.legends[0].entries[4] = {R"({"first":4})", 3};
  part.finish(totals);
  return file;
}

std::string reason_for(const std::string& file) {
  try {
    PartReader(file).check();
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::file_io);
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("parts are read as written, and make the picture in any order") {
  for (const auto& [count, height] : {std::pair(1, area.height), std::pair(2, area.height), std::pair(5, 300),
                                      std::pair(30, area.height)}) {
    const TemporaryFolder folder;
    std::vector<std::filesystem::path> files;
    PartHeader header;
    for (int i = count - 1; i >= 0; --i) {
      header = header_of_shard({i, count});
      header.area.height = height;
      files.emplace_back(write_part(folder, header));
    }
    CHECK(folder.names().size() == size_t(count));  // and nothing else
    PartSet set(files);
    CHECK(set.faults().text() == "");
    REQUIRE_FALSE(set.faults().any());
    CHECK(to_text(*set.header()) == to_text(header));

    const PartTotals totals = set.totals();
    CHECK(totals.rays == 1000u * unsigned(count) + unsigned(count * (count - 1) / 2));
    CHECK(totals.flags == (1u << std::min(count, 4)) - 1);
    CHECK(totals.flagged_pixels == 2u * unsigned(count));
    CHECK(totals.flagged_hits == 3u * unsigned(count));
    CHECK(totals.clamped == 4u * unsigned(count));
    REQUIRE(totals.ray_kinds);
    CHECK(totals.ray_kinds->shadow == 6u * unsigned(count));
    CHECK(totals.seconds == 0.5 * count);
    CHECK(totals.processor_seconds == 1.5 * count);
    CHECK(totals.legends[0].nothing == 9u * unsigned(count));
    CHECK(totals.brightness.counts()[7] == 5u * unsigned(count));
    CHECK(totals.legends[0].entries.at(4).pixels == 3u * unsigned(count));

    std::vector<int> rows(3);
    set.merge([&](size_t plane, const image::Image& image) {
      for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
          for (int c = 0; c < image.channels(); ++c)
            CHECK(image.pixel(x, y)[c] == value_at(plane, area.x + x, area.y + rows[plane] + y, c));
      rows[plane] += image.height();
    });
    CHECK(rows == std::vector<int>(3, height));
  }
}

TEST_CASE("a flipped bit is found in every byte") {
  const TemporaryFolder folder;
  const std::string file = write_part(folder, header_of_shard({1, 4}));
  const std::string sound = read_text(file);
  REQUIRE(reason_for(file) == "");
  for (size_t byte = 0; byte < sound.size(); ++byte) {
    std::string damaged = sound;
    damaged[byte] = char(damaged[byte] ^ 1 << byte % 8);
    write_text(file, damaged);
    CAPTURE(byte);
    CHECK(reason_for(file) != "");
  }
}

TEST_CASE("valid bytes at a wrong position are found") {
  const TemporaryFolder folder;
  PartHeader header = header_of_shard({0, 2});
  header.identity[0].value = "65x48";
  const std::string other = read_text(write_part(folder, header));
  const std::string file = write_part(folder, header_of_shard({0, 2}));
  const std::string sound = read_text(file);
  REQUIRE(other.size() == sound.size());

  // A part with all the planes of another picture.
  const size_t planes = part_prefix_bytes + to_text(header).size() + 4;
  const render::ShardTiles tiles(area, header.shard);
  size_t pixels_and_sums = 0;
  for (size_t plane = 0; plane < header.planes(); ++plane)
    pixels_and_sums += size_t(tiles.pixels() * header.channels(plane) + int64_t(tiles.tiles().size())) * 4;
  std::string mixed = sound;
  mixed.replace(planes, pixels_and_sums, other, planes, pixels_and_sums);
  write_text(file, mixed);
  CHECK(reason_for(file) == "it is damaged: its checksum is wrong");

  // The first two tiles of the picture, exchanged.
  REQUIRE(tiles.tiles()[0].pixels() == tiles.tiles()[1].pixels());
  const auto tile = size_t(tiles.tiles()[0].pixels()) * 3 * 4 + 4;
  mixed = sound;
  mixed.replace(planes, tile, sound, planes + tile, tile).replace(planes + tile, tile, sound, planes, tile);
  write_text(file, mixed);
  CHECK(reason_for(file) == "it is damaged: its checksum is wrong");

  // The picture's plane in place of the normals' plane, which has as many channels.
  const auto plane = size_t(tiles.pixels()) * 3 * 4 + tiles.tiles().size() * 4;
  mixed = sound;
  mixed.replace(planes, plane, sound, planes + pixels_and_sums - plane, plane);
  write_text(file, mixed);
  CHECK(reason_for(file) == "it is damaged: its checksum is wrong");
}

TEST_CASE("an unfinished part leaves no file, and keeps the one before it") {
  const TemporaryFolder folder;
  const PartHeader header = header_of_shard({0, 1});
  const render::ShardTiles tiles(area, header.shard);
  {
    const PartWriter part(folder / "new.eyeray", header, tiles);
  }
  CHECK(folder.names().empty());
  write_text(folder / "old.eyeray", "old");
  {
    PartWriter part(folder / "old.eyeray", header, tiles);
    part.write(0, image::Image(tiles.width(), tiles.height(), 3));
    CHECK(read_text(folder / "old.eyeray") == "old");
  }
  CHECK(read_text(folder / "old.eyeray") == "old");
  CHECK(folder.names() == std::set<std::string>{"old.eyeray"});
}

TEST_CASE("a part that changes while it is merged is found") {
  const TemporaryFolder folder;
  std::vector<std::filesystem::path> files;
  for (const int i : {0, 1}) files.emplace_back(write_part(folder, header_of_shard({i, 2})));
  PartSet set(files);
  REQUIRE_FALSE(set.faults().any());
  std::fstream file(files[1], std::ios::binary | std::ios::in | std::ios::out);
  file.seekp(1000);
  file.put('x');
  file.close();
  try {
    set.merge([](size_t, const image::Image&) {});
    FAIL("it was merged");
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::file_io);
    CHECK(error.what() == files[1].string() + ": it is damaged: its checksum is wrong");
  }
}

TEST_CASE("a part that is too short, too long or no part is refused with the reason") {
  const TemporaryFolder folder;
  const std::string file = write_part(folder, header_of_shard({0, 3}));
  const std::string sound = read_text(file);
  for (size_t size = 0; size < sound.size(); size += 1 + size / 40) {
    write_text(file, sound.substr(0, size));
    CAPTURE(size);
    CHECK(reason_for(file) ==
          (size < part_magic.size() ? "it is not a part of a picture" : "it is damaged: it ends too early"));
  }
  write_text(file, sound + "x");
  CHECK(reason_for(file) == "it is damaged: it has data after its end");
  write_text(file, "P6 1 1 255 and more than twenty bytes");
  CHECK(reason_for(file) == "it is not a part of a picture");
  CHECK(reason_for(folder / "nowhere") == "it cannot be read: No such file or directory");
  CHECK(reason_for(folder.path().string()) == "it is not a regular file");
}

TEST_CASE("random bytes under right checksums are an error, not a crash") {
  Random random(3);
  const std::string text = to_text(header_of_shard({0, 3}));
  int refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string other = text;
    for (int k = 0; k <= i % 3; ++k) other[size_t(random.below(int(text.size())))] = char(random.below(256));
    try {
      header_of(other);
    } catch (const Error& error) {
      CHECK(error.code() == ExitCode::file_io);
      ++refused;
    }
  }
  CHECK(refused > 500);
}

TEST_CASE("a header with values that no picture has is refused") {
  const auto refused = [](const auto& change) {
    PartHeader header = header_of_shard({0, 3});
    change(header);
    try {
      header_of(to_text(header));
    } catch (const Error& error) {
      return error.what() == std::string("it is damaged: its header is invalid");
    }
    return false;
  };
  CHECK_FALSE(refused([](PartHeader&) {}));
  for (const render::Shard shard : {render::Shard{3, 3}, {-1, 3}, {0, 0}, {0, render::most_shards + 1}})
    CHECK(refused([&](PartHeader& header) { header.shard = shard; }));
  for (const Rect& rect : {Rect{-1, 0, 4, 4},
                           {0, -1, 4, 4},
                           {0, 0, 0, 4},
                           {0, 0, 4, 0},
                           {0, 0, 1 << 20, 1 << 20},
                           {65535, 0, 2, 1},
                           {0, 2147483647, 1, 1},
                           {0, 0, 1, 1 << 28}})
    CHECK(refused([&](PartHeader& header) { header.area = rect; }));
  CHECK(refused([](PartHeader& header) { header.samples = 0; }));
  CHECK(refused([](PartHeader& header) { header.tone.curve = image::ToneCurve(99); }));
}

TEST_CASE("a number outside its field's range is refused, not wrapped around or truncated") {
  const auto changed = [](std::string text, const std::string& from, const std::string& to) {
    const size_t start = text.find(from);
    REQUIRE(start != std::string::npos);
    return text.replace(start, from.size(), to);
  };
  const std::string header = to_text(header_of_shard({0, 3})), totals = to_text(PartTotals{});
  for (const std::string number : {"4294967300", "-4294967292", "18446744073709551615", "1e300", "4.5",
                                   "true", "99999999999999999999"}) {
    CAPTURE(number);
    CHECK_THROWS_AS((void)header_of(changed(header, "\"samples\":4", "\"samples\":" + number)), Error);
    CHECK_THROWS_AS((void)header_of(changed(header, "[3,2,43,21]", "[3,2,43," + number + "]")), Error);
    CHECK_THROWS_AS((void)totals_of(changed(totals, "\"flags\":0", "\"flags\":" + number)), Error);
  }
  for (const std::string number : {"-1", "1e300", "0.5", "18446744073709551616"}) {
    CAPTURE(number);
    CHECK_THROWS_AS((void)totals_of(changed(totals, "\"rays\":0", "\"rays\":" + number)), Error);
  }
  CHECK(totals_of(changed(totals, "\"rays\":0", "\"rays\":18446744073709551615")).rays == ~uint64_t{0});
}

TEST_CASE("all faults of a set are named at once") {
  const TemporaryFolder folder;
  std::vector<std::filesystem::path> files;
  for (const int i : {0, 1, 4, 5}) files.emplace_back(write_part(folder, header_of_shard({i, 8})));
  const std::string twin = folder / "twin.eyeray";
  std::filesystem::copy_file(files[1], twin);
  files.emplace_back(twin);
  PartHeader other = header_of_shard({6, 8});
  other.identity[0].value = "65x48";
  other.identity[1].value = "ffff";
  files.emplace_back(write_part(folder, other));
  files.emplace_back(write_part(folder, header_of_shard({2, 9})));
  write_text(folder / "broken.eyeray", read_text(files[0]).substr(0, 500));
  files.emplace_back(folder / "broken.eyeray");

  const PartSet set(files);
  const PartFaults& faults = set.faults();
  CHECK(faults.missing == std::vector<int>{2, 3, 6, 7});
  CHECK(faults.count == 8);
  REQUIRE(faults.damaged.size() == 1);
  CHECK(faults.damaged[0] == folder / "broken.eyeray" + ": it is damaged: it ends too early");
  REQUIRE(faults.doubled.size() == 1);
  CHECK(faults.doubled[0] == files[1].string() + " and " + twin + " are both 2/8");
  REQUIRE(faults.foreign.size() == 2);
  CHECK(faults.foreign[0] ==
        folder / "7-8.eyeray" +
            " is of another picture; these differ: the size (65x48, of most 64x48), the scene");
  CHECK(faults.foreign[1] ==
        folder / "3-9.eyeray" + " is of another picture; these differ: the number of shards (9, of most 8)");
  CHECK(faults.text().ends_with("missing: 3/8 to 4/8, 7/8 to 8/8"));
  const auto refused_as = [](const PartFaults& each) {
    try {
      each.refuse();
    } catch (const Error& error) {
      return error.code();
    }
    return ExitCode::ok;
  };
  CHECK(refused_as(faults) == ExitCode::file_io);
  files.pop_back();
  CHECK(refused_as(PartSet(files).faults()) == ExitCode::bad_input);
}

TEST_CASE("among equally many parts of two pictures, the first one named decides; devices may differ") {
  const TemporaryFolder folder;
  PartHeader other = header_of_shard({1, 2});
  other.samples = 5;
  other.device = "another";
  const std::string first = write_part(folder, header_of_shard({0, 2})), second = write_part(folder, other);
  CHECK(PartSet({first, second}).header()->samples == 4);
  CHECK(PartSet({second, first}).header()->samples == 5);
  CHECK(PartSet({second, first}).faults().missing == std::vector<int>{0});
  other.samples = 4;
  CHECK(PartSet({first, write_part(folder, other)}).faults().text() == "");
}

TEST_CASE("a share is I/N, from 1 to N") {
  CHECK(parse_shard("1/1") == render::Shard{0, 1});
  CHECK(parse_shard("64/64") == render::Shard{63, 64});
  for (const char* text :
       {"", "3", "0/4", "5/4", "-1/4", "1/0", "1/4/2", "1/4 ", "a/b", "/4", "1/", "1/9999999"})
    CHECK_THROWS_AS(parse_shard(text), Error);
}
