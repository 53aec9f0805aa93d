// Renders that are interrupted and resumed; and other files in place of a checkpoint.
#include "host/render/checkpoint.hpp"

#include "fake_executor.hpp"
#include "host/core/checksum.hpp"
#include "tests/support/process.hpp"
#include "tests/support/random.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::render;
using namespace eyeray::engine::test;

namespace {

const std::vector<IdentityPart> identity{{"size", "9x7"}, {"scene", "0123456789abcdef", false}};
constexpr double seldom = 1e6;

RenderOptions options_of(const Scene& scene, int band_rows, Checkpoint* checkpoint) {
  RenderOptions options;
  options.band_bytes = band_of_rows(scene, band_rows);
  options.checkpoint = checkpoint;
  options.channels = film::parse_channels("hits,rays");  // as render() has them
  return options;
}

// Renders until the call `stop`, and leaves the checkpoint behind.
void render_part(const Scene& scene, int band_rows, const std::string& file, int stop) {
  Checkpoint checkpoint = Checkpoint::begin(file, identity, seldom);
  FakeExecutor executor([=](int call) { return call != stop; });
  const Rendering part = render::render(scene, executor, options_of(scene, band_rows, &checkpoint));
  REQUIRE(part.interrupted);
  REQUIRE(checkpoint.failure() == "");
}

Rendering render_rest(const Scene& scene, int band_rows, const std::string& file, int stop = -1) {
  Checkpoint checkpoint = Checkpoint::resume(file, identity, seldom);
  FakeExecutor executor([=](int call) { return call != stop; });
  Rendering rest = render::render(scene, executor, options_of(scene, band_rows, &checkpoint));
  if (!rest.interrupted) checkpoint.remove();
  return rest;
}

// True if the checkpoint is refused as damaged.
bool refused(const Scene& scene, int band_rows, const std::string& file) {
  try {
    render_rest(scene, band_rows, file);
    return false;
  } catch (const Error& error) {
    return error.code() == ExitCode::cannot_resume &&
           std::string(error.what()).find(file) != std::string::npos;
  }
}

}  // namespace

TEST_CASE("a picture interrupted anywhere and resumed equals the uninterrupted one") {
  const TemporaryFolder folder;
  const std::string file = folder / "a";
  const Scene scene = scene_of(9, 7, 4);
  for (const int band_rows : {7, 3}) {
    const int calls = band_rows == 7 ? 4 : 12;
    FakeExecutor undisturbed;
    const Rendering whole = render::render(scene, undisturbed, options_of(scene, band_rows, nullptr));
    for (int stop = 0; stop < calls; ++stop) {
      CAPTURE(band_rows);
      CAPTURE(stop);
      render_part(scene, band_rows, file, stop);
      const Rendering rest = render_rest(scene, band_rows, file);
      CHECK(same_rendering(rest, whole));
      CHECK(rest.samples_taken == 9u * 7u * 4u);
      CHECK((rest.samples_resumed > 0) == (stop > 0));
      CHECK(folder.names().empty());

      // Resumes again from `stop`, with one call in each run.
      render_part(scene, band_rows, file, stop);
      Rendering last;
      int runs = 0;
      do {
        last = render_rest(scene, band_rows, file, 1);
        ++runs;
      } while (last.interrupted);
      CHECK(runs == std::max(1, calls - stop));
      CHECK(same_rendering(last, whole));
      CHECK(folder.names().empty());
    }
  }
}

TEST_CASE("a picture interrupted within a sample of a band equals the uninterrupted one" *
          doctest::test_suite("long")) {
  // The picture is so wide that a band takes several calls.
  const TemporaryFolder folder;
  const std::string file = folder / "a";
  const Scene scene = scene_of(1 << 19, 10, 4);
  FakeExecutor undisturbed;
  const Rendering whole = render::render(scene, undisturbed, options_of(scene, 5, nullptr));
  bool within = false;
  for (const int stop : {1, 4, 9}) {
    CAPTURE(stop);
    render_part(scene, 5, file, stop);
    within = within || Checkpoint::resume(file, identity, seldom).position().extra_rows > 0;
    CHECK(same_rendering(render_rest(scene, 5, file), whole));
  }
  CHECK(within);
}

TEST_CASE("a failed render leaves its checkpoint; a killed one leaves the last checkpoint that was due") {
  const TemporaryFolder folder;
  const std::string file = folder / "a";
  const Scene scene = scene_of(9, 7, 4);
  FakeExecutor undisturbed;
  const Rendering whole = render::render(scene, undisturbed, options_of(scene, 3, nullptr));
  {
    Checkpoint checkpoint = Checkpoint::begin(file, identity, seldom);
    FakeExecutor failing([](int call) {
      if (call == 6) throw Error(ExitCode::no_device, "lost");
      return true;
    });
    CHECK_THROWS_AS(render::render(scene, failing, options_of(scene, 3, &checkpoint)), Error);
  }
  CHECK(Checkpoint::resume(file, identity, seldom).position().samples == 2);
  CHECK(same_rendering(render_rest(scene, 3, file), whole));

  // Every call is followed by a checkpoint; rows that the killed run wrote afterwards are dropped.
  const TemporaryFolder killed;
  {
    Checkpoint checkpoint = Checkpoint::begin(file, identity, 0);
    FakeExecutor copying([&](int call) {
      if (call == 7) std::filesystem::copy(file, killed / "a");
      return true;
    });
    CHECK(same_rendering(render::render(scene, copying, options_of(scene, 3, &checkpoint)), whole));
    std::filesystem::copy(file + ".rows", killed / "a.rows");
  }
  CHECK(std::filesystem::file_size(killed / "a.rows") == 6 * 9 * 24);
  CHECK(Checkpoint::resume(killed / "a", identity, seldom).position().finished_rows == 3);
  CHECK(same_rendering(render_rest(scene, 3, killed / "a"), whole));
}

TEST_CASE("after the last sample, a resumed render delivers its rows without sampling") {
  const TemporaryFolder folder;
  const std::string file = folder / "a";
  const Scene scene = scene_of(9, 7, 4);
  for (const int band_rows : {3, 7}) {
    FakeExecutor undisturbed;
    const Rendering whole = render::render(scene, undisturbed, options_of(scene, band_rows, nullptr));
    {
      Checkpoint checkpoint = Checkpoint::begin(file, identity, seldom);
      FakeExecutor executor;
      const RowSink full_disk = [](const film::Rows& rows) {
        if (rows.first + rows.color.height() == 7) throw Error(ExitCode::file_io, "full");
      };
      CHECK_THROWS_AS(render_rows(scene, executor, options_of(scene, band_rows, &checkpoint), full_disk),
                      Error);
    }
    Checkpoint checkpoint = Checkpoint::resume(file, identity, seldom);
    FakeExecutor executor([](int) -> bool { throw std::runtime_error("nothing is left to sample"); });
    const Rendering rest = render::render(scene, executor, options_of(scene, band_rows, &checkpoint));
    CHECK(same_rendering(rest, whole));
    checkpoint.remove();
  }
}

TEST_CASE("another render's checkpoint is refused, and the error names the differences") {
  const TemporaryFolder folder;
  const std::string file = folder / "a";
  render_part(scene_of(9, 7, 4), 3, file, 5);
  const auto message = [&](const std::vector<IdentityPart>& other) {
    try {
      Checkpoint::resume(file, other, seldom);
    } catch (const Error& error) {
      CHECK(error.code() == ExitCode::cannot_resume);
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string start =
      "cannot resume from " + file + ": it was made with other options or files; these differ: ";
  CHECK(message({{"size", "7x9"}, identity[1]}) == start + "the size (9x7, now 7x9)");
  CHECK(message({identity[0], {"scene", "other", false}}) == start + "the scene");
  CHECK(message({{"size", "9x71"}, {"scene", "", false}, {"new", "x"}}) ==
        start + "the size (9x7, now 9x71), the scene, the new (, now x)");
  CHECK(message(identity) == "");

  CHECK_THROWS_AS(Checkpoint::begin(file, identity, seldom), Error);
  CHECK_THROWS_AS(Checkpoint::resume(folder / "none", identity, seldom), Error);
  CHECK_THROWS_AS(Checkpoint::resume(folder.path(), identity, seldom), Error);
}

TEST_CASE("a checkpoint cut anywhere or with any byte changed is refused" * doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string file = folder / "a";
  const Scene scene = scene_of(9, 7, 4);
  render_part(scene, 3, file, 7);
  Random random(3);
  for (const std::string& part : {file, file + ".rows"}) {
    CAPTURE(part);
    const std::string good = read_text(part);
    REQUIRE(good.size() > 400);
    for (size_t length = 0; length < good.size(); ++length) {
      CAPTURE(length);
      write_text(part, good.substr(0, length));
      REQUIRE(refused(scene, 3, file));
    }
    for (size_t i = 0; i < good.size(); ++i) {
      CAPTURE(i);
      std::string bad = good;
      bad[i] = char(bad[i] ^ (1 << random.below(8)));
      write_text(part, bad);
      REQUIRE(refused(scene, 3, file));
    }
    // Rows that a killed run appended do not count as damage; bytes behind the sums do.
    write_text(part, good + "x");
    CHECK(refused(scene, 3, file) == (part == file));
    render_part(scene, 3, file + "again", 7);
    std::filesystem::rename(file + "again", file);
    std::filesystem::rename(file + "again.rows", file + ".rows");
  }
  std::filesystem::remove(file + ".rows");
  CHECK_THROWS_AS(render_rest(scene, 3, file), Error);
}

TEST_CASE("a checkpoint with false values and the right checksum is refused") {
  const TemporaryFolder folder;
  const std::string file = folder / "a";
  const Scene scene = scene_of(9, 7, 4);
  render_part(scene, 3, file, 7);
  const std::string good = read_text(file);
  const size_t position = 16 + *reinterpret_cast<const uint32_t*>(&good[12]);

  // Writes `value` in place of the n-th number of RenderPosition.
  const auto lie = [&](size_t n, uint64_t value) {
    std::string bad = good;
    bad.replace(position + 8 * n, 8, reinterpret_cast<const char*>(&value), 8);
    const size_t end = position + 48 + 4;
    const uint32_t sum = crc32(std::as_bytes(std::span(bad.data(), end)));
    bad.replace(end, 4, reinterpret_cast<const char*>(&sum), 4);
    write_text(file, bad);
    return refused(scene, 3, file);
  };
  for (const uint64_t rows : {uint64_t{1}, uint64_t{4}, uint64_t{6}, uint64_t{7}, uint64_t{9}, ~uint64_t{0},
                              uint64_t{1} << 32, (uint64_t{1} << 32) + 3}) {
    CAPTURE(rows);
    CHECK(lie(0, rows));
  }
  for (const uint64_t samples : {uint64_t{5}, ~uint64_t{0}, uint64_t{1} << 32}) CHECK(lie(1, samples));
  for (const uint64_t extra : {uint64_t{3}, ~uint64_t{0}, uint64_t{1} << 32}) CHECK(lie(2, extra));
  // Checkpoints of another band's size, or of no size at all, are refused.
  write_text(file, good);
  CHECK(refused(scene, 2, file));
  CHECK(refused(scene, 7, file));
  CHECK_FALSE(refused(scene, 3, file));
}

TEST_CASE("an unwritable checkpoint is reported, and the render goes on") {
  const TemporaryFolder folder;
  const std::string inner = folder / "inner";
  std::filesystem::create_directory(inner);
  const Scene scene = scene_of(9, 7, 4);
  FakeExecutor undisturbed;
  const Rendering whole = render::render(scene, undisturbed, options_of(scene, 3, nullptr));
  Checkpoint checkpoint = Checkpoint::begin(inner + "/a", identity, 0);
  FakeExecutor executor([&](int call) {
    if (call == 1) std::filesystem::remove_all(inner);
    return true;
  });
  CHECK(same_rendering(render::render(scene, executor, options_of(scene, 3, &checkpoint)), whole));
  CHECK(checkpoint.failure().find("No such file or directory") != std::string::npos);
  CHECK_FALSE(checkpoint.due());
}
