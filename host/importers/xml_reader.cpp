#include "host/importers/xml_reader.hpp"

#include <expat.h>
#include <fmt/format.h>

#include "host/importers/malformed.hpp"

namespace eyeray::engine::importers {

namespace {

constexpr int most_depth = 64;
constexpr long long most_tag_bytes = 1 << 20;

// The position of the event that is read. expat 2.9 deprecates these functions in favour of ones that 2.5
// lacks.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
long long byte_of(XML_Parser expat) {
  return static_cast<long long>(XML_GetCurrentByteIndex(expat));
}
int line_of(XML_Parser expat) {
  return int(XML_GetCurrentLineNumber(expat));
}
int column_of(XML_Parser expat) {
  return int(XML_GetCurrentColumnNumber(expat)) + 1;
}
#pragma GCC diagnostic pop

}  // namespace

struct XmlReader::Parser {
  explicit Parser(XmlReader& reader) : expat(XML_ParserCreateNS(nullptr, '|')) {
    if (!expat) throw std::bad_alloc();
    XML_SetUserData(expat, &reader);
    XML_SetElementHandler(
        expat,
        [](void* self, const char* name, const char** attributes) {
          auto& to = *static_cast<XmlReader*>(self);
          to.guard([&] {
            if (++to.depth_ > most_depth)
              to.fail(fmt::format("elements are nested more than {} deep", most_depth));
            to.start(name, XmlAttributes(attributes));
          });
        },
        [](void* self, const char* name) {
          auto& to = *static_cast<XmlReader*>(self);
          to.guard([&] {
            --to.depth_;
            to.end(name);
          });
        });
    // Entities can only be defined in a document type.
    XML_SetStartDoctypeDeclHandler(expat, [](void* self, const char*, const char*, const char*, int) {
      auto& to = *static_cast<XmlReader*>(self);
      to.guard([&] { to.fail("a document type (DOCTYPE) is not allowed here"); });
    });
  }
  ~Parser() { XML_ParserFree(expat); }
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;

  XML_Parser expat;
};

std::optional<std::string_view> XmlAttributes::find(std::string_view name) const {
  for (const char* const* pair = pairs_; *pair; pair += 2)
    if (*pair == name) return pair[1];
  return std::nullopt;
}

XmlReader::XmlReader(std::string file) : file_(std::move(file)), parser_(new Parser(*this)) {}

XmlReader::~XmlReader() = default;

// Runs a step within a callback. What it throws is kept until expat has returned.
template <typename Step>
void XmlReader::guard(Step step) {
  if (thrown_) return;
  try {
    step();
  } catch (...) {
    thrown_ = std::current_exception();
    XML_StopParser(parser_->expat, XML_FALSE);
  }
}

void XmlReader::feed(std::string_view piece, bool last) {
  const XML_Parser expat = parser_->expat;
  const XML_Status status = XML_Parse(expat, piece.data(), int(piece.size()), last);
  if (thrown_) std::rethrow_exception(thrown_);
  if (status == XML_STATUS_ERROR)
    fail(fmt::format("this is no well-formed XML ({})", XML_ErrorString(XML_GetErrorCode(expat))));
  fed_ += static_cast<long long>(piece.size());
  // expat keeps a tag that has not ended, and reads it again with each piece.
  if (!last && fed_ - byte_of(expat) > most_tag_bytes)
    fail("a tag, a comment or a text is longer than 1 MiB");
}

void XmlReader::fail(const std::string& message) const {
  throw malformed(file_, message, line(), column());
}

int XmlReader::line() const {
  return line_of(parser_->expat);
}

int XmlReader::column() const {
  return column_of(parser_->expat);
}

}  // namespace eyeray::engine::importers
