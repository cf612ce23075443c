// SPDX-License-Identifier: Apache-2.0
// Turns the callbacks of expat into virtual functions.
// expat may report a few more events after it was stopped.
#include "motion/xml_stream.hpp"

#include <fmt/format.h>

#include "motion/input_text.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

template <class Function>
void XmlStream::guarded(void* self, const Function& function) {
  XmlStream& reader = *static_cast<XmlStream*>(self);
  if (reader.error_) return;
  try {
    function(reader);
  } catch (...) {
    reader.error_ = std::current_exception();
    XML_StopParser(reader.parser_.get(), XML_FALSE);
  }
}

XmlStream::XmlStream(ByteStream& stream, const char* kind)
    : stream_(stream), kind_(kind), parser_(XML_ParserCreate(nullptr)) {
  if (!parser_) throw RuntimeError("not enough memory for an XML parser");
  XML_SetUserData(parser_.get(), this);
  XML_SetElementHandler(
      parser_.get(),
      [](void* self, const XML_Char* name, Attributes attributes) {
        guarded(self, [&](XmlStream& reader) { reader.start(name, attributes); });
      },
      [](void* self, const XML_Char* name) { guarded(self, [&](XmlStream& reader) { reader.end(name); }); });
  XML_SetCharacterDataHandler(parser_.get(), [](void* self, const XML_Char* text, int size) {
    guarded(self, [&](XmlStream& reader) { reader.text({text, static_cast<size_t>(size)}); });
  });
  XML_SetCommentHandler(parser_.get(), [](void* self, const XML_Char* text) {
    guarded(self, [&](XmlStream& reader) { reader.comment(text); });
  });
}

void XmlStream::fail(std::string_view what) const { fail_at(file(), line(), what); }

const XML_Char* XmlStream::find(Attributes attributes, std::string_view name) {
  for (; *attributes; attributes += 2)
    if (*attributes == name) return attributes[1];
  return nullptr;
}

void XmlStream::parse_all(std::string_view unfinished) {
  for (std::string_view chunk = stream_.next(); !chunk.empty(); chunk = stream_.next()) parse(chunk, false, unfinished);
  parse({}, true, unfinished);
}

void XmlStream::parse(std::string_view chunk, bool last, std::string_view unfinished) {
  constexpr uint64_t longest = 1 << 20;  // expat reads an unfinished tag or comment again with every chunk
  bytes_ += chunk.size();
  if (XML_Parse(parser_.get(), chunk.data(), static_cast<int>(chunk.size()), last) == XML_STATUS_OK) {
    const XML_Index begin = XML_GetCurrentByteIndex(parser_.get());  // beginning of the unfinished part
    if (!last && begin >= 0 && bytes_ - static_cast<uint64_t>(begin) > longest)
      fail(fmt::format("a tag, an attribute or a comment of more than {} bytes begins here; this is not {}", longest,
                       kind_));
    return;
  }
  if (error_) std::rethrow_exception(error_);
  const XML_Error code = XML_GetErrorCode(parser_.get());
  if (last) fail(unfinished);
  throw InputError(fmt::format("{}:{}:{}: not well-formed XML: {}", file(), line(),
                               XML_GetCurrentColumnNumber(parser_.get()) + 1, XML_ErrorString(code)));
}

}  // namespace wavetracer
