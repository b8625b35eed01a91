#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <limits>
#include <string>
#include <type_traits>

#include "flight/mavlink/frame.h"

/// Our end of mavlink_peer_test.js:
///   mavlink_stream write any|least|greatest [signed]   every message of ours, framed, to stdout
///   mavlink_stream read [signed]                       frames of stdin, a line each: id and values
/// `any`: the k-th value of a message (elements of arrays count) is (7 k + id) mod 100 + 1; least
/// and greatest: of each field's type. The key is 0, 1, …, 31.
namespace saker::flight::mavlink {
namespace {

Signing signing_of_the_test() {
  Signing signing;
  for (std::size_t i = 0; i < signing.key.size(); ++i)
    signing.key[i] = static_cast<std::uint8_t>(i);
  return signing;
}

/// Calls f(value) for each value of a message, elements of arrays alone.
template <class Message, class F>
void for_all_values(Message& message, const F& f) {
  std::remove_const_t<Message>::visit(message, [&](const char*, auto& field) {
    if constexpr (codec::IsArray<std::decay_t<decltype(field)>>::value)
      for (auto& element : field) f(element);
    else
      f(field);
  });
}

template <class Message>
Message filled(const std::string& how) {
  Message message;
  std::uint32_t k = 0;
  for_all_values(message, [&]<class T>(T& value) {
    value = static_cast<T>((7 * k++ + Message::kId) % 100 + 1);
    if (how == "least") value = std::numeric_limits<T>::lowest();
    if (how == "greatest") value = std::numeric_limits<T>::max();
  });
  return message;
}

int write_all(const std::string& how, Signing* signing) {
  FrameWriter writer(1, 191);
  bool good = true;
  const auto write = [&]<class Message>(Message) {
    const auto frame = writer.write(filled<Message>(how), signing, 1'000'000);
    good = good && frame &&
           std::fwrite(frame->bytes.data(), 1, frame->length, stdout) == frame->length;
  };
  std::apply([&](auto... messages) { (write(messages), ...); }, AllMessages{});
  return good ? 0 : 1;
}

template <class Message>
void print(const Frame& frame) {
  if (frame.id != Message::kId) return;
  std::string line = fmt::format("{}", frame.id);
  const auto message = decode<Message>(frame.bytes());
  for_all_values(message, [&]<class T>(const T& value) {
    if constexpr (std::is_floating_point_v<T>)
      line += fmt::format(" {:.17g}", static_cast<double>(value));
    else if constexpr (std::is_same_v<T, char>)
      line += fmt::format(" {}", static_cast<unsigned char>(value));
    else
      line += fmt::format(" {}", +value);
  });
  fmt::print("{}\n", line);
}

int read_all(Signing* signing) {
  FrameReader reader(signing);
  const auto take = [&] {
    while (const auto frame = reader.next(1)) {
      std::apply([&](auto... messages) { (print<decltype(messages)>(*frame), ...); },
                 AllMessages{});
    }
  };
  std::array<std::uint8_t, 64> buffer;
  for (std::size_t count; (count = std::fread(buffer.data(), 1, buffer.size(), stdin)) > 0;) {
    std::span<const std::uint8_t> bytes(buffer.data(), count);
    while (!bytes.empty()) {
      bytes = bytes.subspan(reader.push(bytes));
      take();
    }
  }
  reader.settle();
  take();
  const FrameReader::Counters& c = reader.counters();
  const bool clean =
      c.damaged == 0 && c.unknown == 0 && c.unsigned_ == 0 && c.forged == 0 && c.skipped == 0;
  return clean ? 0 : 1;
}

}  // namespace
}  // namespace saker::flight::mavlink

int main(int argc, char** argv) {
  using namespace saker::flight::mavlink;
  const std::string does = argc > 1 ? argv[1] : "", how = argc > 2 ? argv[2] : "";
  Signing signing = signing_of_the_test();
  Signing* const with = std::string(argv[argc - 1]) == "signed" ? &signing : nullptr;
  if (does == "read") return read_all(with);
  if (does == "write" && (how == "any" || how == "least" || how == "greatest"))
    return write_all(how, with);
  return 2;
}
