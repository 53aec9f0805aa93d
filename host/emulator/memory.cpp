#include "host/emulator/memory.hpp"

namespace eyeray::engine::emulator {
namespace {

enum : uint8_t { none, plain, by_atomic };

}  // namespace

void Accesses::restart(size_t words) {
  words_.assign(words, {});
}

bool Accesses::read(size_t at, const Moment& now, bool atomic) {
  Word& word = words_[at];
  const bool free = word.writer.kind == none || (atomic && word.writer.kind == by_atomic) ||
                    word.writer.moment.ordered_with(now);
  const Access access{now, uint8_t(atomic ? by_atomic : plain)};
  // Keeps two of many readers, so that a later writer finds another one than itself.
  const bool same = word.reader.kind != none && word.reader.moment.group == now.group &&
                    word.reader.moment.invocation == now.invocation;
  if (word.reader.kind != none && !same) word.other_reader = word.reader;
  word.reader = access;
  return free;
}

bool Accesses::write(size_t at, const Moment& now, bool atomic) {
  Word& word = words_[at];
  const auto conflicts = [&](const Access& access) {
    return access.kind != none && !(atomic && access.kind == by_atomic) && !access.moment.ordered_with(now);
  };
  const bool free = !conflicts(word.writer) && !conflicts(word.reader) && !conflicts(word.other_reader);
  word.writer = {now, uint8_t(atomic ? by_atomic : plain)};
  return free;
}

}  // namespace eyeray::engine::emulator
