#include <string>
#include <vector>

#include "host/core/free_memory.hpp"
#include "host/core/raw_vector.hpp"
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;

TEST_CASE("freed blocks give their memory back") {
  std::string text(1000, 'a');
  free_memory(text);
  CHECK(text.empty());
  CHECK_LT(text.capacity(), 1000u);

  std::vector<int> numbers(1000);
  free_memory(numbers);
  CHECK_EQ(numbers.capacity(), 0u);
}

TEST_CASE("a raw vector leaves new elements as they are in memory") {
  RawVector<int> numbers(4, 7);
  numbers.clear();
  numbers.resize(4);
  CHECK_EQ(numbers[3], 7);
  numbers.push_back(8);
  CHECK_EQ(numbers, RawVector<int>{7, 7, 7, 7, 8});
}
