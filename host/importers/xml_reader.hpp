// Reads XML as a stream, by expat. Private to the importers.
#pragma once

#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace eyeray::engine::importers {

// The attributes of one element. They exist only during the call that gets them.
class XmlAttributes {
 public:
  explicit XmlAttributes(const char* const* pairs) : pairs_(pairs) {}

  // The value of an attribute. One of a namespace is called "namespace|name".
  std::optional<std::string_view> find(std::string_view name) const;

 private:
  const char* const* pairs_;  // name, value, …, null
};

class XmlReader {
 public:
  // `file`: the name for messages.
  explicit XmlReader(std::string file);
  virtual ~XmlReader();
  XmlReader(const XmlReader&) = delete;
  XmlReader& operator=(const XmlReader&) = delete;

  // Reads on. InputError at the position of a fault: XML that is not well-formed, a document type, more than
  // 64 nested elements, a tag of more than 1 MiB, or an error of `start` or `end`.
  void feed(std::string_view piece, bool last);

 protected:
  // An element's start and end. Names are "namespace|name".
  virtual void start(std::string_view name, const XmlAttributes& attributes) = 0;
  virtual void end(std::string_view name) = 0;
  // The current position.
  int line() const;
  int column() const;
  // Throws an InputError there.
  [[noreturn]] void fail(const std::string& message) const;

 private:
  struct Parser;  // expat's
  template <typename Step>
  void guard(Step step);

  std::string file_;
  std::unique_ptr<Parser> parser_;
  int depth_ = 0;
  long long fed_ = 0;          // bytes
  std::exception_ptr thrown_;  // by a callback; expat is C
};

}  // namespace eyeray::engine::importers
