#include <cstdio>
#include <string_view>
#include <type_traits>

#include "flight/mavlink/frame.h"

/// Every message of ours, framed, to stdout: for mavlink_peer_test.js. The k-th value of a message
/// (elements of arrays count) is (7 k + id) mod 100 + 1. With the argument "signed" each frame is
/// signed with the key 0, 1, …, 31.
namespace saker::flight::mavlink {
namespace {

template <class Message>
Message filled() {
  Message message;
  std::uint32_t k = 0;
  const auto fill = [&]<class T>(T& value) {
    value = static_cast<T>((7 * k++ + Message::kId) % 100 + 1);
  };
  Message::visit(message, [&](const char*, auto& field) {
    if constexpr (codec::IsArray<std::decay_t<decltype(field)>>::value)
      for (auto& element : field) fill(element);
    else
      fill(field);
  });
  return message;
}

int write_all(bool is_signed) {
  Signing signing;
  for (std::size_t i = 0; i < signing.key.size(); ++i)
    signing.key[i] = static_cast<std::uint8_t>(i);
  FrameWriter writer(1, 191);
  bool good = true;
  const auto write = [&]<class Message>(Message) {
    const auto frame = writer.write(filled<Message>(), is_signed ? &signing : nullptr, 1'000'000);
    good = good && frame &&
           std::fwrite(frame->bytes.data(), 1, frame->length, stdout) == frame->length;
  };
  std::apply([&](auto... messages) { (write(messages), ...); }, AllMessages{});
  return good ? 0 : 1;
}

}  // namespace
}  // namespace saker::flight::mavlink

int main(int argc, char** argv) {
  return saker::flight::mavlink::write_all(argc > 1 && std::string_view(argv[1]) == "signed");
}
