// The fuzzer's test of a kernel: SPIR-V that the validator accepts is refused by the emulator, or it runs,
// twice to the same bits and findings. The mutator changes instructions, so that many modules stay valid.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <random>

#include <spirv-tools/libspirv.hpp>

#include "host/core/error.hpp"
#include "host/emulator/emulator.hpp"

using namespace eyeray::engine;

namespace {

constexpr uint64_t most_operations = 1 << 22;
constexpr size_t header_words = 5;

std::vector<uint32_t> words_of(const uint8_t* data, size_t size) {
  std::vector<uint32_t> words(size / 4);
  if (!words.empty()) std::memcpy(words.data(), data, words.size() * 4);
  return words;
}

// All buffers and images after a run, and the findings as text.
std::string result_of(const emulator::Kernel& kernel, emulator::Order order) {
  std::vector<uint32_t> memory[4];
  for (std::vector<uint32_t>& each : memory)
    for (uint32_t n = 0; n < 64; ++n) each.push_back(n * n);
  const auto bytes = [&](size_t n) { return std::as_writable_bytes(std::span(memory[n])); };
  const std::vector<std::byte> pushed(32);
  emulator::Findings findings;
  const emulator::Work work{.buffers = {{0, bytes(0)}, {1, bytes(1)}, {2, bytes(2)}},
                            .images = {{3, {{4, 4, 1}, {}, bytes(3)}}},
                            .push_constants = pushed,
                            .order = order,
                            .watch =
                                [](uint64_t operations) {
                                  if (operations > most_operations)
                                    throw Error(ExitCode::timed_out, "the kernel runs too long");
                                },
                            .findings = &findings};
  std::string result;
  try {
    kernel.run(work, {2, 1, 1});
  } catch (const Error& error) {
    if (error.code() != ExitCode::timed_out && error.code() != ExitCode::bad_input) std::abort();
    result = error.what();
  }
  for (const std::vector<uint32_t>& each : memory)
    result.append(reinterpret_cast<const char*>(each.data()), each.size() * 4);
  for (const emulator::Finding& each : findings.all()) result += describe(each);
  return result;
}

// The first word of each instruction; empty for words that are not SPIR-V.
std::vector<size_t> instructions_of(const std::vector<uint32_t>& words) {
  std::vector<size_t> starts;
  for (size_t at = header_words; at < words.size(); at += words[at] >> 16) {
    if (words[at] >> 16 == 0 || (words[at] >> 16) > words.size() - at) return {};
    starts.push_back(at);
  }
  return starts;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::vector<uint32_t> words = words_of(data, size);
  spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_1);
  tools.SetMessageConsumer([](auto...) {});
  if (!tools.Validate(words)) return 0;
  try {
    const emulator::Kernel kernel(words, "fuzzed");
    const std::string first = result_of(kernel, emulator::Order::ascending);
    if (first != result_of(kernel, emulator::Order::ascending)) std::abort();
    result_of(kernel, emulator::Order::descending);
  } catch (const Error& error) {
    if (error.code() != ExitCode::bad_input) std::abort();
  }
  return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed) {
  std::vector<uint32_t> words = words_of(data, size);
  std::mt19937 random(seed);
  const auto below = [&](size_t count) { return size_t(random() % count); };
  for (size_t n = 1 + below(3); n-- > 0;) {
    const std::vector<size_t> starts = instructions_of(words);
    if (starts.empty()) break;
    const size_t at = starts[below(starts.size())], other = starts[below(starts.size())];
    const auto first = words.begin() + ptrdiff_t(at), end = first + (words[at] >> 16);
    const std::vector<uint32_t> instruction(first, end);
    const bool has_operands = instruction.size() > 1;
    switch (below(6)) {
      case 0:
        words.erase(first, end);
        break;
      case 1:  // a copy elsewhere
        words.insert(words.begin() + ptrdiff_t(other), instruction.begin(), instruction.end());
        break;
      case 2:  // another opcode of the same length
        words[at] = (words[at] & 0xffff0000u) | ((words[at] + uint32_t(below(9)) - 4) & 0xffffu);
        break;
      case 3:
        if (has_operands) words[at + 1 + below(instruction.size() - 1)] += uint32_t(below(5)) - 2;
        break;
      default:  // an operand from elsewhere
        if (has_operands)
          words[at + 1 + below(instruction.size() - 1)] = words[other + below(words[other] >> 16)];
    }
  }
  const size_t bytes = std::min(words.size() * 4, most);
  if (bytes > 0) std::memcpy(data, words.data(), bytes);
  return bytes;
}
