// Tests of the page's view of the worker's messages.
#include "host/dev/board.hpp"

#include <cmath>
#include <limits>

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::dev;

namespace {

Message rows(int row, int count, int stride, const std::vector<float>& values) {
  Message message{{{"view", "gpu"},
                   {"width", 5},
                   {"height", 3},
                   {"row", row},
                   {"channels", 3},
                   {"rows", count},
                   {"stride", stride}},
                  ""};
  message.bytes.assign(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
  return message;
}

// n pixels, all the same grey.
std::vector<float> grey(int n, float value) {
  return std::vector<float>(size_t(n) * 3, value);
}

}  // namespace

TEST_CASE("a picture grows by rows, and a coarse one fills squares") {
  Board board;
  CHECK_FALSE(board.picture("gpu"));
  std::vector<float> coarse = grey(3 * 2, 1);
  coarse[3] = 0.5f;  // the second square of the upper row
  board.put_rows(rows(0, 2, 2, coarse));
  image::Image image = board.picture("gpu")->image;
  CHECK(image.pixel(1, 1)[0] == 1);
  CHECK(image.pixel(2, 0)[0] == 0.5f);
  CHECK(image.pixel(3, 1)[0] == 0.5f);
  CHECK(image.pixel(4, 2)[2] == 1);

  board.put_rows(rows(1, 2, 1, grey(10, 0.25f)));
  image = board.picture("gpu")->image;
  CHECK(image.pixel(2, 0)[0] == 0.5f);
  CHECK(image.pixel(2, 1)[0] == 0.25f);
  CHECK(image.pixel(4, 2)[0] == 0.25f);
}

TEST_CASE("a picture has the tone of its rows, and a difference has none") {
  Board board;
  Message message = rows(0, 1, 1, grey(5, 1));
  message.json["tone"] = {{"exposure", 1.5}, {"curve", int(image::ToneCurve::agx)}, {"white_balance", 5000}};
  for (const char* view : {"gpu", "reference"}) {
    message.json["view"] = view;
    board.put_rows(message);
  }
  CHECK(board.picture("gpu")->tone.exposure == 1.5);
  CHECK(board.picture("gpu")->tone.curve == image::ToneCurve::agx);
  CHECK(board.picture("gpu")->tone.white_balance == 5000);
  CHECK(board.difference()->tone.exposure == 0);
  CHECK(board.difference()->tone.curve == image::ToneCurve::none);
  message.json["tone"]["curve"] = 99;
  board.put_rows(message);
  CHECK(board.picture("reference")->tone.curve == image::ToneCurve::none);
}

TEST_CASE("rows not rendered yet have no value") {
  Board board;
  board.put_rows(rows(0, 1, 1, grey(5, 1)));
  CHECK(std::isnan(board.picture("gpu")->image.pixel(0, 1)[0]));
}

TEST_CASE("pictures are compared where both have equally many samples") {
  Board board;
  const auto put = [&](const char* view, int row, int generation, int sample,
                       const std::vector<float>& values) {
    Message message = rows(row, 1, 1, values);
    message.json["view"] = view;
    message.json["generation"] = generation;
    message.json["sample"] = sample;
    board.put_rows(message);
  };
  const auto difference = [&](int x, int y) { return board.difference()->image.pixel(x, y)[0]; };
  for (int y = 0; y < 3; ++y) put("gpu", y, 1, 0, grey(5, 0.5f));
  CHECK_FALSE(board.difference());
  for (int y = 0; y < 3; ++y) put("reference", y, 1, 0, grey(5, 0.25f));
  CHECK(difference(0, 0) == 0.25f);

  // Another picture: the reference's old rows have no difference; rows with fewer samples have none either.
  for (int y = 0; y < 3; ++y) put("gpu", y, 2, 1, grey(5, 1));
  CHECK(std::isnan(difference(0, 0)));
  put("reference", 0, 2, 0, grey(5, 0.5f));
  CHECK(std::isnan(difference(0, 0)));
  put("reference", 0, 2, 1, grey(5, 1));
  CHECK(difference(0, 0) == 0);
  CHECK(std::isnan(difference(0, 1)));

  // Pixels that are NaN differ by 0 from NaN, and by infinity from numbers.
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> values = grey(5, 1);
  values[0] = values[3] = nan;
  put("gpu", 1, 2, 1, values);
  values[3] = 1;
  put("reference", 1, 2, 1, values);
  CHECK(difference(0, 1) == 0);
  CHECK(difference(1, 1) == std::numeric_limits<float>::infinity());
}

TEST_CASE("rows of inconsistent size or position are ignored") {
  Board board;
  for (const Message& message :
       {rows(0, 1, 1, grey(4, 1)), rows(-1, 1, 1, grey(5, 1)), rows(3, 1, 1, grey(5, 1)),
        rows(2, 2, 1, grey(10, 1)), rows(0, 1, 0, grey(5, 1)), rows(0, 0, 1, {}),
        rows(0, std::numeric_limits<int>::max(), 1, grey(5, 1)), Message{{{"view", "gpu"}}, ""}})
    board.put_rows(message);
  CHECK_FALSE(board.picture("gpu"));
}

TEST_CASE("waiting for the status returns at changes, and at the end") {
  Board board;
  uint64_t seen = 0;
  CHECK_FALSE(board.next_status(seen, 0));
  board.update([](Json& status) { status["state"] = "done"; });
  CHECK(board.next_status(seen, 600) == R"({"state":"done"})");
  CHECK_FALSE(board.next_status(seen, 0));
  board.put_probe({{"x", 1}});
  CHECK(Json::parse(*board.next_status(seen, 600)).at("probes") == 1);
  CHECK(board.probe().at("x") == 1);
  board.close();
  CHECK_FALSE(board.next_status(seen, 600));
}
