#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// JSON that a person or another program wrote. Every error is an Error that names the file, the
/// place in it, what was found and what was expected.
namespace saker::tools {

/// A value of a file, and the way to it for messages.
class JsonNode {
 public:
  JsonNode(const nlohmann::json& value, std::string path) : value_(value), path_(std::move(path)) {}

  [[nodiscard]] bool has(const std::string& key) const;
  [[nodiscard]] JsonNode at(const std::string& key) const;
  [[nodiscard]] bool is_text() const { return value_.is_string(); }
  [[nodiscard]] double number() const;
  [[nodiscard]] bool boolean() const;
  [[nodiscard]] std::string text() const;
  [[nodiscard]] std::vector<double> numbers(std::size_t count) const;  ///< all finite
  void each_element(const std::function<void(const JsonNode&)>& use) const;
  void each_field(const std::function<void(const std::string&, const JsonNode&)>& use) const;

 private:
  [[noreturn]] void fail(const std::string& expected) const;

  const nlohmann::json& value_;
  std::string path_;
};

[[nodiscard]] nlohmann::json read_json(const std::filesystem::path& file);

}  // namespace saker::tools
