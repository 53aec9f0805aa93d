#include "benchmarks/bench/field.hpp"

#include <nlohmann/json.hpp>

#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::bench;
using eyeray::engine::test::TemporaryFolder;
using eyeray::engine::test::write_text;

namespace {

FieldReport sample(double our_seconds) {
  const auto timing = [](const char* name, ContenderKind kind, double seconds) {
    return Timing{name, kind, {seconds, seconds * 0.9, seconds * 1.1}, kind == ContenderKind::ours ? 3u : 0u};
  };
  FieldReport report;
  for (const uint64_t size : {1000u, 1000000u}) {
    report.push_back({"terrain <" + std::to_string(size) + ">",
                      "terrain",
                      size,
                      {{"Embree", 0.5, size * 80}},
                      {{"primary",
                        1'000'000,
                        {timing("Embree single", ContenderKind::single, 0.1),
                         timing("gpu", ContenderKind::ours, our_seconds),
                         timing("Embree packets of 8", ContenderKind::packet, 0.05),
                         timing("Embree packets of 16", ContenderKind::packet, 0.04)}}}});
  }
  return report;
}

size_t count(const std::string& text, const std::string& word) {
  size_t found = 0;
  for (size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += word.size()) ++found;
  return found;
}

}  // namespace

TEST_CASE("ratios compare with the fastest contender of a kind") {
  const BatchReport batch = sample(0.08)[0].batches[0];
  CHECK(rate(batch, batch.timings[0]) == doctest::Approx(1e7));
  CHECK(times_as_fast(batch, batch.timings[1], ContenderKind::single) == doctest::Approx(1.25));
  CHECK(times_as_fast(batch, batch.timings[1], ContenderKind::packet) == doctest::Approx(0.5));
  CHECK(fastest(batch, ContenderKind::packet)->contender == "Embree packets of 16");
  CHECK(fastest({}, ContenderKind::ours) == nullptr);
}

TEST_CASE("the table has a row for each of our contenders and single rays, and one for the fastest packets") {
  const std::string text = to_text(sample(0.08));
  CHECK(count(text, "Embree packets of 16") == 2);
  CHECK(count(text, "packets of 8") == 0);
  CHECK(text.find("1.25") != std::string::npos);
  CHECK(text.find("80.0 bytes a primitive") != std::string::npos);
  for (size_t at = 0; at < text.size();) {
    const size_t end = text.find('\n', at);
    CHECK(end - at <= 110);
    at = end + 1;
  }
}

TEST_CASE("a report survives JSON, and --compare lists the changes") {
  const TemporaryFolder folder;
  const std::string file = folder / "old.json";
  write_text(file, nlohmann::ordered_json{{"field", to_json(sample(0.1))}}.dump());
  const FieldReport old = read_field_report(file);
  REQUIRE(old.size() == 2);
  CHECK(old[1].builds[0].bytes == 80'000'000);
  CHECK(old[1].batches[0].timings[3].kind == ContenderKind::packet);
  CHECK(old[1].batches[0].timings[1].seconds.max == doctest::Approx(0.11));

  const std::string same = changes(old, sample(0.1));
  CHECK(count(same, "+0.0 %  within the spread") == 8);
  CHECK(count(same, "+0.0 %, 80000000 -> 80000000 bytes\n") == 1);
  const std::string faster = changes(old, sample(0.05));
  CHECK(count(faster, "+100.0 %\n") == 2);
  CHECK(count(faster, "within the spread") == 6);
  CHECK(changes({}, sample(1)).empty());
}

TEST_CASE("a file that is not a report is refused in one line") {
  const TemporaryFolder folder;
  const std::string file = folder / "old.json";
  const std::string good = nlohmann::ordered_json{{"field", to_json(sample(0.1))}}.dump();
  for (const std::string& bad :
       {std::string("{"), std::string("[]"), std::string("{\"field\": 3}"), std::string("{\"field\": [{}]}"),
        good.substr(0, good.size() / 2), std::string(100'000, '['),
        "{\"field\": [], \"more\": " + std::string(64, '[') + std::string(64, ']') + "}"}) {
    write_text(file, bad);
    try {
      read_field_report(file);
      FAIL("it was read");
    } catch (const Error& error) {
      CHECK(error.code() == ExitCode::bad_input);
      CHECK(error.what() == file + " is not what eyeray-bench --json answers");
    }
  }
  CHECK_THROWS_AS(read_field_report(folder / "nothing"), Error);
}
