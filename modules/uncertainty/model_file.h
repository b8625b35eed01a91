#pragma once

#include <string>
#include <string_view>

#include "saker/objects/class_table.h"
#include "saker/uncertainty/uncertainty.h"

/// Model files: YAML with a comment on every key, under a line with the SHA-256 of all that follows
/// it, so that a file that was cut or edited is refused. Errors are one line: file, key, what was
/// found, what was expected.
namespace saker::uncertainty {

[[nodiscard]] std::string model_text(const Model& model, const objects::ClassTable& table);

/// \param source  how messages call the text; throws Error
[[nodiscard]] Model model_from_text(const std::string& text, const std::string& source,
                                    const objects::ClassTable& table);

/// `body` as a file: with the opening comment and its checksum.
[[nodiscard]] std::string sealed(std::string_view body);

}  // namespace saker::uncertainty
