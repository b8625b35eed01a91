#include "flight/link/fragments.h"

#include "saker/exchange/bytes.h"

namespace saker::flight {

std::string to_bytes(const Fragment& fragment) {
  exchange::ByteWriter out;
  out.text(fragment.channel);
  out.fixed(fragment.number);
  out.fixed(fragment.index);
  out.fixed(fragment.count);
  out.raw(fragment.bytes);
  return out.bytes();
}

std::optional<Fragment> fragment_of(std::string_view bytes) {
  exchange::ByteReader in(bytes);
  Fragment fragment;
  fragment.channel = in.text();
  fragment.number = in.fixed<std::uint32_t>();
  fragment.index = in.fixed<std::uint16_t>();
  fragment.count = in.fixed<std::uint16_t>();
  if (in.failed() || fragment.index >= fragment.count) return std::nullopt;
  fragment.bytes = in.raw(in.rest());
  return fragment;
}

std::optional<std::string> FragmentJoiner::add(Fragment fragment) {
  if (every_ && fragment.count == 1) return std::move(fragment.bytes);
  if (fragment.number < number_) {
    ++incomplete_;
    return std::nullopt;
  }
  if (fragment.number > number_) {
    incomplete_ += missing_ > 0;
    number_ = fragment.number;
    missing_ = fragment.count;
    pieces_.assign(fragment.count, std::nullopt);
  }
  if (missing_ == 0 || fragment.count != pieces_.size() || pieces_[fragment.index])
    return std::nullopt;
  pieces_[fragment.index] = std::move(fragment.bytes);
  if (--missing_ > 0) return std::nullopt;
  std::string message;
  for (const auto& piece : pieces_) message += *piece;
  pieces_.clear();
  return message;
}

}  // namespace saker::flight
