// SPDX-License-Identifier: Apache-2.0
// Reads an XML file through expat, chunk by chunk: elements, texts and comments as they come, with line numbers for
// messages. Exceptions must not cross expat, which is C: a callback stores its exception and stops the parser.
#pragma once
#include <expat.h>

#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <string_view>

#include "motion/byte_stream.hpp"

namespace wavetracer {

class XmlStream {
 public:
  using Attributes = const XML_Char**;

  // kind: what the file should be, for messages, such as "an FCD output". The stream must outlive this object.
  XmlStream(ByteStream& stream, const char* kind);
  virtual ~XmlStream() = default;
  XmlStream(const XmlStream&) = delete;
  XmlStream& operator=(const XmlStream&) = delete;

 protected:
  // Reads to the end; unfinished: message if the file ends before its last element does. Throws InputError.
  void parse_all(std::string_view unfinished);

  virtual void start(std::string_view name, Attributes attributes) = 0;
  virtual void end(std::string_view) {}
  virtual void text(std::string_view) {}
  virtual void comment(std::string_view) {}

  const std::string& file() const { return stream_.file(); }
  uint64_t line() const { return XML_GetCurrentLineNumber(parser_.get()); }
  [[noreturn]] void fail(std::string_view what) const;
  // Returns the value of an attribute, or nullptr.
  static const XML_Char* find(Attributes attributes, std::string_view name);

 private:
  void parse(std::string_view chunk, bool last, std::string_view unfinished);
  template <class Function>
  static void guarded(void* self, const Function& function);

  struct FreeParser {
    void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
  };

  ByteStream& stream_;
  const char* kind_;
  std::unique_ptr<XML_ParserStruct, FreeParser> parser_;
  std::exception_ptr error_;  // exception that a callback threw
  uint64_t bytes_ = 0;        // bytes given to the parser
};

}  // namespace wavetracer
