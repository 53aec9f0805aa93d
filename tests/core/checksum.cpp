#include "host/core/checksum.hpp"

#include <string_view>

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;

TEST_CASE("a checksum continues from an earlier one, also over no bytes") {
  const auto bytes = [](std::string_view text) { return std::as_bytes(std::span(text)); };
  CHECK(crc32(bytes("123456789")) == 0xcbf43926);  // the check value of CRC-32/ISO-HDLC
  CHECK(crc32(bytes("6789"), crc32(bytes("12345"))) == 0xcbf43926);
  CHECK(crc32({}, 0xcbf43926) == 0xcbf43926);
}
