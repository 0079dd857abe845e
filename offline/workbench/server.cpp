// SPDX-License-Identifier: Apache-2.0
// The only file that uses Boost, whose headers take long to compile; boost_functions.cpp holds the
// rest of it.
#include "workbench/server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <set>

#include "program/problem.hpp"
#include "workbench/access.hpp"

namespace plumb::offline::workbench {

namespace beast = boost::beast;
namespace http = beast::http;
namespace net = boost::asio;
namespace websocket = beast::websocket;
using boost::system::error_code;
using net::ip::tcp;
using namespace std::chrono_literals;

namespace {

constexpr int kMostConnections = 32, kMostTurnedAway = 16;
constexpr std::size_t kThreads = 4, kMostLag = 64, kMostBuffer = std::size_t{128} << 10;
constexpr std::size_t kMostSocketBytes = 4096;  // of a message of the page; it sends none
constexpr auto kPatience = 30s, kFarewell = 2s, kHeartbeat = 10s;

using Parser = http::request_parser<http::string_body>;
using Message = http::response<http::span_body<const char>>;

std::string text_at(const Parser& parser, beast::string_view name) {
  const auto value = parser.get()[name];
  return std::string(value.data(), value.size());
}

/// What the page's server looks at; a header that stands there twice is none that a browser sends,
/// and is refused by being joined.
Request head_of(const Parser& parser) {
  const auto& head = parser.get();
  const auto method = head.method_string();
  const auto target = head.target();
  Request out{.method = std::string(method.data(), method.size()),
              .target = std::string(target.data(), target.size()),
              .origin = text_at(parser, "Origin"),
              .token = text_at(parser, "X-Plumb-Token"),
              .if_match = text_at(parser, "If-Match"),
              .if_none_match = text_at(parser, "If-None-Match")};
  for (auto [at, end] = head.equal_range(http::field::host); at != end; ++at)
    out.host += (out.host.empty() ? "" : ",") + std::string(at->value().data(), at->value().size());
  return out;
}

/// An answer to bytes that are no request; nothing if the connection is just over.
std::optional<Response> answer_to(const error_code& error) {
  const auto say = [](int status, const char* message) {
    return error_response(status, {.code = status == 400 ? "E-SERVE-REQUEST" : "E-SERVE-SIZE",
                                   .message = message,
                                   .help = "docs/workbench.md says what the server takes"});
  };
  if (error == http::error::header_limit || error == http::error::buffer_overflow)
    return say(431, "the headers of the request are too large");
  if (error == http::error::body_limit) return say(413, "the body of the request is too large");
  if (error == http::error::end_of_stream || error == http::error::partial_message)
    return std::nullopt;
  if (error.category() == make_error_code(http::error::bad_method).category())
    return say(400, "this is no HTTP request");
  return std::nullopt;
}

}  // namespace

class SocketSession;

/// What all connections share. Everything of it runs in the thread of `run`, but `answer`.
class Server::Hub {
 public:
  explicit Hub(int port);
  int port() const { return acceptor_.local_endpoint().port(); }
  void run(Answers answers);
  void broadcast(std::string message);

  const Answers& answers() const { return answers_; }
  net::thread_pool& threads() { return threads_; }
  net::io_context& context() { return context_; }

  /// A place among the connections, given back when it goes.
  class Seat {
   public:
    explicit Seat(int& taken) : taken_(taken) { ++taken_; }
    ~Seat() { --taken_; }
    Seat(const Seat&) = delete;
    Seat& operator=(const Seat&) = delete;

   private:
    int& taken_;
  };

  void join(SocketSession* session) { sessions_.insert(session); }
  void leave(SocketSession* session) { sessions_.erase(session); }

 private:
  void accept();
  void admit(tcp::socket socket);
  void beat();

  // Connections refer to these and end with the context, which must therefore go first.
  Answers answers_;
  std::set<SocketSession*> sessions_;
  int seats_ = 0, turned_away_ = 0;

  net::io_context context_{1};
  net::thread_pool threads_{kThreads};
  tcp::acceptor acceptor_{context_};
  net::signal_set signals_{context_};
  net::steady_timer heartbeat_{context_}, pause_{context_};
};

/// A WebSocket: it only sends.
class SocketSession : public std::enable_shared_from_this<SocketSession> {
 public:
  SocketSession(tcp::socket socket, std::function<void(SocketSession*)> leave,
                std::shared_ptr<void> seat)
      : stream_(std::move(socket)), leave_(std::move(leave)), seat_(std::move(seat)) {}
  ~SocketSession() { leave_(this); }
  SocketSession(const SocketSession&) = delete;
  SocketSession& operator=(const SocketSession&) = delete;

  void accept(const http::request<http::string_body>& request, const std::string& greeting) {
    stream_.set_option(websocket::stream_base::timeout{kPatience, kPatience, true});
    stream_.read_message_max(kMostSocketBytes);
    stream_.async_accept(request, [self = shared_from_this(), greeting](const error_code& error) {
      if (error) return;
      self->open_ = true;
      self->send(std::make_shared<const std::string>(greeting));
      self->read();
    });
  }

  void send(Bytes message) {
    if (!open_) return;
    if (queue_.size() >= kMostLag) return close();
    queue_.push_back(std::move(message));
    if (queue_.size() == 1) write();
  }

 private:
  void close() {
    open_ = false;
    error_code ignored;
    beast::get_lowest_layer(stream_).socket().close(ignored);
  }

  void read() {
    stream_.async_read(buffer_, [self = shared_from_this()](const error_code& error, std::size_t) {
      self->buffer_.consume(self->buffer_.size());
      if (error) return self->close();
      self->read();
    });
  }

  void write() {
    stream_.text(true);
    stream_.async_write(net::buffer(*queue_.front()),
                        [self = shared_from_this()](const error_code& error, std::size_t) {
                          if (error) return self->close();
                          self->queue_.pop_front();
                          if (!self->queue_.empty()) self->write();
                        });
  }

  websocket::stream<beast::tcp_stream> stream_;
  beast::flat_buffer buffer_{kMostBuffer};
  std::deque<Bytes> queue_;  // the first one is on its way
  bool open_ = false;
  std::function<void(SocketSession*)> leave_;
  std::shared_ptr<void> seat_;
};

namespace {

/// One HTTP connection, request after request.
template <class Hub>
class Connection : public std::enable_shared_from_this<Connection<Hub>> {
 public:
  Connection(tcp::socket socket, Hub& hub, std::shared_ptr<void> seat)
      : stream_(std::move(socket)), hub_(hub), seat_(std::move(seat)) {}

  void begin() { read_head(); }

  /// Answers at once, and ends.
  void turn_away(Response response) {
    stream_.expires_after(kFarewell);
    write(std::move(response), false);
  }

 private:
  void read_head() {
    parser_.emplace();
    parser_->header_limit(kMostHeaderBytes);
    parser_->body_limit(kMostUpload);
    stream_.expires_after(kPatience);
    http::async_read_header(stream_, buffer_, *parser_,
                            [self = this->shared_from_this()](const error_code& error,
                                                              std::size_t) { self->head(error); });
  }

  void head(const error_code& error) {
    if (error) return refuse(error);
    const Request request = head_of(*parser_);
    if (websocket::is_upgrade(parser_->get())) return upgrade(request);
    if (auto refused = hub_.answers().refuse(request)) return write(std::move(*refused), false);
    const std::size_t most = most_body(request);
    const auto length = parser_->content_length();
    if (length && *length > most) return refuse(http::error::body_limit);
    if (!length) parser_->body_limit(most);
    http::async_read(stream_, buffer_, *parser_,
                     [self = this->shared_from_this()](const error_code& failed, std::size_t) {
                       self->body(failed);
                     });
  }

  void body(const error_code& error) {
    if (error) return refuse(error);
    Request request = head_of(*parser_);
    request.body = std::move(parser_->get().body());
    if (request.body.size() > most_body(request)) return refuse(http::error::body_limit);
    const bool keep = parser_->get().keep_alive();
    stream_.expires_never();
    net::post(hub_.threads(),
              [self = this->shared_from_this(), request = std::move(request), keep]() mutable {
                auto response = std::make_shared<Response>(self->hub_.answers().answer(request));
                net::post(self->hub_.context(),
                          [self, response, keep] { self->write(std::move(*response), keep); });
              });
  }

  void upgrade(const Request& request) {
    if (auto refused = hub_.answers().refuse_socket(request))
      return write(std::move(*refused), false);
    stream_.expires_never();
    const auto session = std::make_shared<SocketSession>(
        stream_.release_socket(), [&hub = hub_](SocketSession* one) { hub.leave(one); }, seat_);
    hub_.join(session.get());
    session->accept(parser_->release(), hub_.answers().greeting());
  }

  void refuse(const error_code& error) {
    if (auto response = answer_to(error)) write(std::move(*response), false);
  }

  void write(Response response, bool keep) {
    body_ = response.body ? response.body : bytes("");
    message_.emplace();
    message_->version(11);
    message_->result(static_cast<unsigned>(response.status));
    for (const auto& [name, value] : headers_of(response)) message_->set(name, value);
    message_->keep_alive(keep);
    if (response.status != 304) {
      message_->body() = beast::span<const char>(body_->data(), body_->size());
      message_->prepare_payload();
    }
    stream_.expires_after(kPatience);
    http::async_write(
        stream_, *message_,
        [self = this->shared_from_this(), keep](const error_code& error, std::size_t) {
          if (error) return;
          if (keep) return self->read_head();
          self->leave();
        });
  }

  /// Takes what the other side still sends, so that the answer is not lost with it.
  void leave() {
    error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    stream_.expires_after(kFarewell);
    drain(0);
  }

  void drain(std::size_t taken) {
    if (taken > kMostUpload) return;
    stream_.async_read_some(net::buffer(rest_), [self = this->shared_from_this(), taken](
                                                    const error_code& error, std::size_t n) {
      if (!error) self->drain(taken + n);
    });
  }

  beast::tcp_stream stream_;
  beast::flat_buffer buffer_{kMostBuffer};
  std::optional<Parser> parser_;
  std::optional<Message> message_;
  Bytes body_;
  std::array<char, 4096> rest_{};
  Hub& hub_;
  std::shared_ptr<void> seat_;
};

}  // namespace

Server::Hub::Hub(int port) {
  const tcp::endpoint here(net::ip::address_v4::loopback(), static_cast<unsigned short>(port));
  error_code error;
  acceptor_.open(here.protocol(), error);
  if (!error) acceptor_.set_option(net::socket_base::reuse_address(true), error);
  if (!error) acceptor_.bind(here, error);
  if (!error) acceptor_.listen(net::socket_base::max_listen_connections, error);
  if (error)
    throw Failure(Exit::kEnvironment,
                  {.code = "E-SERVE-PORT",
                   .message = fmt::format("port {} of this machine cannot be used: {}", port,
                                          error.message()),
                   .help = "let the system choose one: plumb serve"});
}

void Server::Hub::run(Answers answers) {
  answers_ = std::move(answers);
  signals_.add(SIGINT);
  signals_.add(SIGTERM);
  signals_.async_wait([this](const error_code&, int) { context_.stop(); });
  accept();
  beat();
  context_.run();
  answers_.stopping();
  threads_.stop();
  threads_.join();
}

void Server::Hub::accept() {
  acceptor_.async_accept([this](const error_code& error, tcp::socket socket) {
    if (!error) {
      admit(std::move(socket));
      return accept();
    }
    // No file descriptor is left, perhaps: some are given back soon.
    pause_.expires_after(100ms);
    pause_.async_wait([this](const error_code& stopped) {
      if (!stopped) accept();
    });
  });
}

void Server::Hub::admit(tcp::socket socket) {
  const bool full = seats_ >= kMostConnections;
  if (full && turned_away_ >= kMostTurnedAway) return;
  const auto seat = std::make_shared<Seat>(full ? turned_away_ : seats_);
  const auto one = std::make_shared<Connection<Hub>>(std::move(socket), *this, seat);
  if (!full) return one->begin();
  one->turn_away(error_response(
      503, {.code = "E-SERVE-BUSY",
            .message = fmt::format("{} connections are open, which is all that are served",
                                   kMostConnections),
            .help = "close some pages of the workbench"}));
}

void Server::Hub::beat() {
  heartbeat_.expires_after(kHeartbeat);
  heartbeat_.async_wait([this](const error_code& error) {
    if (error) return;
    broadcast(R"({"type":"ping"})");
    beat();
  });
}

void Server::Hub::broadcast(std::string message) {
  net::post(context_, [this, text = bytes(std::move(message))] {
    const auto present = sessions_;  // one that lags behind may leave meanwhile
    for (SocketSession* session : present)
      if (sessions_.contains(session)) session->send(text);
  });
}

Server::Server(int port) : hub_(std::make_unique<Hub>(port)) {}
Server::~Server() = default;
int Server::port() const { return hub_->port(); }
void Server::run(Answers answers) { hub_->run(std::move(answers)); }
void Server::broadcast(std::string message) { hub_->broadcast(std::move(message)); }

}  // namespace plumb::offline::workbench
