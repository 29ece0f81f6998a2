#pragma once

#include <string>

namespace prospect::report {

// The pieces of a page that refers to nothing outside itself.

/// The text with the five characters that mean something in HTML replaced, and control characters
/// by spaces.
std::string Escaped(const std::string& text);

/// `inside` between the tags of an element. @param attributes as they stand in the tag; may be
/// empty
std::string Element(const std::string& tag, const std::string& attributes,
                    const std::string& inside);

/// RFC 4648, with padding.
std::string Base64(const std::string& bytes);

}  // namespace prospect::report
