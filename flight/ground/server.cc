#include "flight/ground/server.h"

#include <libwebsockets.h>

#include <array>
#include <atomic>
#include <cstring>
#include <map>
#include <thread>

#include "saker/core/error.h"

namespace saker::flight::ground {
namespace {

using Steady = Hub::Steady;

constexpr std::size_t kMostMessage = kMostClientBytes;
constexpr int kPlain = 0;  // index of the protocol of those that chose none

/// Whole, however long it is: an origin that does not fit is still one.
std::string header(lws* wsi, lws_token_indexes token) {
  const int whole = lws_hdr_total_length(wsi, token);
  if (whole <= 0) return {};
  std::string text(static_cast<std::size_t>(whole) + 1, '\0');
  const int size = lws_hdr_copy(wsi, text.data(), static_cast<int>(text.size()), token);
  if (size < 0) return "unreadable";
  text.resize(static_cast<std::size_t>(size));
  return text;
}

std::string key_in_address(lws* wsi) {
  std::array<char, 256> text{};
  const char* found =
      lws_get_urlarg_by_name(wsi, "key=", text.data(), static_cast<int>(text.size()));
  return found != nullptr ? found : "";
}

std::string peer(lws* wsi) {
  std::array<char, 64> text{};
  lws_get_peer_simple(wsi, text.data(), text.size());
  return text.data();
}

/// What libwebsockets keeps of a connection.
struct Connection {
  Hub::SessionId session;
  std::string* partial;  // of a message in several fragments
};

}  // namespace

class Server::Loop {
 public:
  Loop(const ServerConfig& config, Hub& hub);
  ~Loop();

  [[nodiscard]] int port() const { return port_; }
  [[nodiscard]] const ServerConfig& config() const { return config_; }
  [[nodiscard]] long refused() const { return refused_; }

 private:
  struct Tick {
    lws_sorted_usec_list_t list;  // first: it is what libwebsockets gives back
    Loop* loop;
  };

  static int on_event(lws* wsi, lws_callback_reasons reason, void* user, void* in, size_t size);
  static void on_tick(lws_sorted_usec_list_t* list);
  int serve_file(lws* wsi, const char* path);
  int filter(lws* wsi);
  int opened(lws* wsi, Connection& connection);
  int received(lws* wsi, Connection& connection, const void* in, std::size_t size);
  int write(lws* wsi, const Connection& connection);
  void closed(Connection& connection);
  void wake_writers();
  void cut_stuck();

  ServerConfig config_;
  Hub& hub_;
  Gate gate_;
  std::array<lws_protocols, 4> protocols_{};
  lws_context* context_ = nullptr;
  int port_ = 0;
  std::map<Hub::SessionId, lws*> clients_;
  Tick tick_{};
  std::atomic<long> refused_ = 0;
  std::atomic<bool> stops_ = false;
  std::thread thread_;
};

Server::Loop::Loop(const ServerConfig& config, Hub& hub)
    : config_(config), hub_(hub), gate_(config.tls ? config.tls->key : "", !config.tls) {
  const auto protocol = [](const char* name) {
    lws_protocols p{};
    p.name = name;
    p.callback = on_event;
    p.per_session_data_size = sizeof(Connection);
    p.rx_buffer_size = 4096;
    return p;
  };
  protocols_ = {protocol("http"), protocol(kSubprotocols[0]), protocol(kSubprotocols[1]), {}};
  lws_set_log_level(LLL_ERR, [](int, const char*) {});
  lws_context_creation_info info{};
  info.iface = config_.address.c_str();
  info.port = config_.port;
  info.protocols = protocols_.data();
  info.gid = info.uid = -1;
  info.user = this;
  info.keepalive_timeout = 20;  // s
  info.timeout_secs = 10;
  info.fd_limit_per_thread = 512;
  info.options = LWS_SERVER_OPTION_FAIL_UPON_UNABLE_TO_BIND | LWS_SERVER_OPTION_DISABLE_IPV6 |
                 LWS_SERVER_OPTION_VALIDATE_UTF8;
  std::string certificate, private_key;
  if (config_.tls) {
    certificate = config_.tls->certificate.string();
    private_key = config_.tls->private_key.string();
    info.ssl_cert_filepath = certificate.c_str();
    info.ssl_private_key_filepath = private_key.c_str();
    info.options |= LWS_SERVER_OPTION_DO_SSL_GLOBAL_INIT;
  }
  context_ = lws_create_context(&info);
  lws_vhost* vhost = context_ == nullptr ? nullptr : lws_get_vhost_by_name(context_, "default");
  port_ = vhost == nullptr ? -1 : lws_get_vhost_listen_port(vhost);
  if (port_ <= 0) {
    if (context_ != nullptr) lws_context_destroy(context_);
    throw Error(
        "port " + std::to_string(config_.port) + " of " + config_.address +
        " cannot be had: another program has it, or there is no such address (ground.port)");
  }
  hub_.on_output([this] { lws_cancel_service(context_); });
  tick_.loop = this;
  thread_ = std::thread([this] {
    lws_sul_schedule(context_, 0, &tick_.list, on_tick, LWS_US_PER_SEC);
    while (!stops_ && lws_service(context_, 0) >= 0) {
    }
  });
}

Server::Loop::~Loop() {
  stops_ = true;
  lws_cancel_service(context_);
  thread_.join();
  hub_.on_output({});
  lws_context_destroy(context_);
}

void Server::Loop::on_tick(lws_sorted_usec_list_t* list) {
  Loop& loop = *reinterpret_cast<Tick*>(list)->loop;
  loop.cut_stuck();
  lws_sul_schedule(loop.context_, 0, list, on_tick, LWS_US_PER_SEC);
}

int Server::Loop::on_event(lws* wsi, lws_callback_reasons reason, void* user, void* in,
                           size_t size) {
  auto* loop = static_cast<Loop*>(lws_context_user(lws_get_context(wsi)));
  auto* connection = static_cast<Connection*>(user);
  switch (reason) {
    case LWS_CALLBACK_HTTP:
      return loop->serve_file(wsi, static_cast<const char*>(in));
    case LWS_CALLBACK_HTTP_FILE_COMPLETION:
      return lws_http_transaction_completed(wsi) != 0 ? -1 : 0;
    case LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION:
      return loop->filter(wsi);
    case LWS_CALLBACK_ESTABLISHED:
      return loop->opened(wsi, *connection);
    case LWS_CALLBACK_RECEIVE:
      return loop->received(wsi, *connection, in, size);
    case LWS_CALLBACK_SERVER_WRITEABLE:
      return loop->write(wsi, *connection);
    case LWS_CALLBACK_CLOSED:
      loop->closed(*connection);
      return 0;
    case LWS_CALLBACK_EVENT_WAIT_CANCELLED:
      if (loop != nullptr) loop->wake_writers();
      return 0;
    default:
      return lws_get_protocol(wsi) != nullptr ? lws_callback_http_dummy(wsi, reason, user, in, size)
                                              : 0;
  }
}

int Server::Loop::serve_file(lws* wsi, const char* path) {
  const auto file = page_file(config_.page, path != nullptr ? path : "");
  const bool get = lws_hdr_total_length(wsi, WSI_TOKEN_GET_URI) > 0;
  if (!get || !file) {
    const unsigned code = get ? HTTP_STATUS_NOT_FOUND : HTTP_STATUS_METHOD_NOT_ALLOWED;
    if (lws_return_http_status(wsi, code, nullptr) != 0) return -1;
    return lws_http_transaction_completed(wsi) != 0 ? -1 : 0;
  }
  static constexpr char kHeaders[] =
      "cache-control: no-cache\x0d\x0a"
      "x-content-type-options: nosniff\x0d\x0a"
      "referrer-policy: no-referrer\x0d\x0a"
      "content-security-policy: frame-ancestors 'none'\x0d\x0a";
  const int sent = lws_serve_http_file(wsi, file->c_str(), media_type(*file), kHeaders,
                                       static_cast<int>(sizeof kHeaders) - 1);
  if (sent < 0 || (sent > 0 && lws_http_transaction_completed(wsi) != 0)) return -1;
  return 0;
}

/// Nonzero refuses the WebSocket.
int Server::Loop::filter(lws* wsi) {
  const bool chose = lws_get_protocol(wsi) != &protocols_[kPlain] &&
                     std::strcmp(lws_get_protocol(wsi)->name, "http") != 0;
  const Knock knock{.host = header(wsi, WSI_TOKEN_HOST),
                    .origin = header(wsi, WSI_TOKEN_ORIGIN),
                    .key = key_in_address(wsi)};
  if (chose && gate_.admits(knock) && clients_.size() < config_.most_clients) return 0;
  ++refused_;
  lws_return_http_status(wsi, chose ? HTTP_STATUS_FORBIDDEN : HTTP_STATUS_BAD_REQUEST, nullptr);
  return 1;
}

int Server::Loop::opened(lws* wsi, Connection& connection) {
  const bool sdk = std::strcmp(lws_get_protocol(wsi)->name, kSubprotocols[1]) == 0;
  connection.partial = new std::string;
  connection.session = hub_.open(peer(wsi), sdk, Steady::now());
  clients_[connection.session] = wsi;
  lws_callback_on_writable(wsi);
  return 0;
}

int Server::Loop::received(lws* wsi, Connection& connection, const void* in, std::size_t size) {
  std::string& message = *connection.partial;
  bool fine = message.size() + size <= kMostMessage;
  if (fine) {
    message.append(static_cast<const char*>(in), size);
    if (lws_is_final_fragment(wsi) == 0 || lws_remaining_packet_payload(wsi) > 0) return 0;
  }
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(message.data());
  const bool binary = lws_frame_is_binary(wsi) != 0;
  if (!fine) message.clear();  // what is too long is garbage
  fine = hub_.hear(connection.session, {bytes, message.size()}, binary, Steady::now());
  message.clear();
  if (fine) return 0;
  unsigned char why[] = "not of the protocol";
  lws_close_reason(wsi, LWS_CLOSE_STATUS_PROTOCOL_ERR, why, sizeof why - 1);
  return -1;
}

int Server::Loop::write(lws* wsi, const Connection& connection) {
  const auto next = hub_.take(connection.session, Steady::now());
  if (!next) return 0;
  const std::size_t size = next->head.size() + next->body->size();
  std::string buffer(LWS_PRE, '\0');
  buffer.reserve(LWS_PRE + size);
  buffer += next->head;
  buffer += *next->body;
  auto* begin = reinterpret_cast<unsigned char*>(buffer.data()) + LWS_PRE;
  const auto kind = next->binary ? LWS_WRITE_BINARY : LWS_WRITE_TEXT;
  if (lws_write(wsi, begin, size, kind) < static_cast<int>(size)) return -1;
  lws_callback_on_writable(wsi);
  return 0;
}

void Server::Loop::closed(Connection& connection) {
  if (connection.partial == nullptr) return;
  hub_.close(connection.session);
  clients_.erase(connection.session);
  delete connection.partial;
  connection.partial = nullptr;
}

void Server::Loop::wake_writers() {
  for (const Hub::SessionId id : hub_.with_output()) {
    const auto at = clients_.find(id);
    if (at != clients_.end()) lws_callback_on_writable(at->second);
  }
}

void Server::Loop::cut_stuck() {
  for (const Hub::SessionId id : hub_.stuck(Steady::now())) {
    const auto at = clients_.find(id);
    if (at != clients_.end())
      lws_set_timeout(at->second, PENDING_TIMEOUT_CLOSE_SEND, LWS_TO_KILL_ASYNC);
  }
}

Server::Server(const ServerConfig& config, Hub& hub) : loop_(std::make_unique<Loop>(config, hub)) {}
Server::~Server() = default;

int Server::port() const { return loop_->port(); }
long Server::refused() const { return loop_->refused(); }

std::string Server::address() const {
  const ServerConfig& config = loop_->config();
  const std::string place = config.address + ":" + std::to_string(port()) + "/";
  return (config.tls ? "https://" : "http://") + place;
}

}  // namespace saker::flight::ground
