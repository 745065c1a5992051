// SPDX-License-Identifier: Apache-2.0
// Tests of the web server while a session hands on samples: who stalls or misbehaves holds up
// nobody.
#include "host/web/web_server.hpp"

#include <array>
#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/streambuf.hpp>
#include <boost/asio/write.hpp>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <istream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/unit/host/headers.hpp"
#include "tests/unit/host/rig_text.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;
using namespace std::chrono_literals;
using boost::asio::ip::tcp;

const RigFile kRig = parse_rig(std::string(kRigText), "rig.toml").value();

/// A server of a page into which a thread puts a sample each millisecond, as a session would. Of
/// what says 100 Hz every sample is shown.
class Watched {
 public:
  explicit Watched(WebLimits limits = {}, std::optional<std::string> recording = {},
                   double rate_hz = 1000)
      : rate_hz_(rate_hz) {
    auto listener = WebListener::open({.host = "127.0.0.1", .port = 0});
    REQUIRE(listener);
    const std::string url = (*listener)->url();
    port_ = url.substr(url.rfind(':') + 1, url.size() - 2 - url.rfind(':'));
    server_ = std::make_unique<WebServer>(
        std::move(*listener), WebGuard("127.0.0.1", ""), page_,
        WebActions{.start_recording = [] { return tl::expected<void, Error>(); },
                   .stop_recording = [] { return failure("No recording is under way."); },
                   .mark =
                       [](const std::string& text) {
                         return text == "slow" ? (std::this_thread::sleep_for(300ms),
                                                  tl::expected<void, Error>())
                                               : tl::expected<void, Error>();
                       },
                   .download = [recording = std::move(recording)] { return recording; }},
        limits);
    sampling_ = std::thread([this] { sample(); });
  }
  Watched(const Watched&) = delete;
  Watched& operator=(const Watched&) = delete;
  ~Watched() {
    ended_ = true;
    sampling_.join();
  }

  [[nodiscard]] const std::string& port() const { return port_; }
  /// The longest that the session was held up by one sample so far.
  [[nodiscard]] std::chrono::nanoseconds longest() const { return longest_.load(); }

 private:
  void sample() {
    for (std::uint64_t seq = 0; !ended_; ++seq) {
      const auto begin = std::chrono::steady_clock::now();
      feed_.take(Sample{.seq = seq, .t_us = static_cast<std::int64_t>(seq) * 1000});
      feed_.take(Estimate<double>{.t_us = static_cast<std::int64_t>(seq) * 1000, .seq = seq});
      longest_ = std::max(longest_.load(), std::chrono::steady_clock::now() - begin);
      std::this_thread::sleep_for(1ms);
    }
  }

  double rate_hz_;
  LiveFeed feed_;
  LivePage page_{feed_,
                 {.rig = kRig,
                  .rig_name = "rig",
                  .source = "sim:",
                  .estimator = "gn",
                  .header = header_of("sim", rate_hz_)},
                 [] { return RecordingState(); }};
  std::string port_;
  std::unique_ptr<WebServer> server_;
  std::atomic<bool> ended_ = false;
  std::atomic<std::chrono::steady_clock::duration> longest_{};
  std::thread sampling_;
};

/// A browser, or what pretends to be one.
class Client {
 public:
  /// Of who does not read at once the system keeps about `receive_buffer_bytes`.
  explicit Client(const Watched& watched, std::optional<int> receive_buffer_bytes = {})
      : port_(watched.port()) {
    socket_.open(tcp::v4());
    if (receive_buffer_bytes) {
      socket_.set_option(boost::asio::socket_base::receive_buffer_size(*receive_buffer_bytes));
    }
    socket_.connect(
        {boost::asio::ip::make_address("127.0.0.1"), static_cast<std::uint16_t>(std::stoi(port_))});
  }

  void send(const std::string& text) {
    boost::system::error_code gone;
    boost::asio::write(socket_, boost::asio::buffer(text), gone);
  }
  void ask(const std::string& method, const std::string& target, const std::string& more = "",
           const std::string& body = "") {
    send(method + " " + target + " HTTP/1.1\r\nHost: 127.0.0.1:" + port_ +
         "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n" + more + "\r\n" + body);
  }
  void post(const std::string& target, const std::string& body) {
    ask("POST", target, "X-Penduline: 1\r\nContent-Type: application/json\r\n", body);
  }
  /// The next line, with what ends it; "" at the end.
  std::string line() {
    boost::system::error_code ended;
    boost::asio::read_until(socket_, received_, "\n", ended);
    ended_ = ended && received_.size() == 0;
    std::string text;
    std::istream stream(&received_);
    std::getline(stream, text);
    return text;
  }
  /// Takes what there is, up to `most` bytes, 64 KiB at most; how much, 0 at the end.
  std::size_t take(std::size_t most = 65536) {
    std::array<char, 65536> piece{};
    boost::system::error_code ended;
    return socket_.read_some(boost::asio::buffer(piece, most), ended);
  }
  /// The next event of a stream; both empty at the end.
  struct Event {
    std::string name;
    std::string data;
  };
  Event event() {
    Event found;
    for (std::string text = line(); !ended_; text = line()) {
      if (text.starts_with("event: ")) {
        found.name = text.substr(7);
      } else if (text.starts_with("data: ")) {
        found.data = text.substr(6);
        break;
      }
    }
    return found;
  }
  /// Skips lines until one begins so; false where the connection ends before.
  bool finds(const std::string& begin) {
    for (;;) {
      const std::string text = line();
      if (text.starts_with(begin)) {
        return true;
      }
      if (ended_) {
        return false;
      }
    }
  }

 private:
  std::string port_;
  boost::asio::io_context context_;
  tcp::socket socket_{context_};
  boost::asio::streambuf received_;
  bool ended_ = false;
};

TEST_CASE("A viewer gets session, points and state, and then more points", "[threads]") {
  const Watched watched;
  Client viewer(watched);
  viewer.ask("GET", "/live");
  CHECK(viewer.line() == "HTTP/1.1 200 OK\r");
  for (const char* expected : {"retry: 1000", "event: session", "event: points", "event: state",
                               "event: points", "event: points"}) {
    INFO(expected);
    CHECK(viewer.finds(expected));
  }
}

TEST_CASE("A viewer that reads nothing holds up nobody, and goes on with the newest when it reads",
          "[threads]") {
  const Watched watched({.send_buffer_bytes = 4096}, {}, 100);
  Client stalled(watched, 4096);
  stalled.ask("GET", "/live");
  Client viewer(watched);
  viewer.ask("GET", "/live");
  for (int i = 0; i < 100; ++i) {  // five seconds, where 64 events are kept
    CHECK(viewer.finds("event: points"));
  }
  CHECK(watched.longest() < 200ms);
  const auto moments = [](const Client::Event& points) {
    return nlohmann::json::parse(points.data)["t_s"].get<std::vector<double>>();
  };
  CHECK(stalled.event().name == "session");
  double latest_s = 0;
  Client::Event next = stalled.event();
  for (; next.name == "points" || next.name == "state"; next = stalled.event()) {
    const auto moments_s = next.name == "points" ? moments(next) : std::vector<double>();
    latest_s = moments_s.empty() ? latest_s : moments_s.back();
  }
  CHECK(next.name == "session");
  CHECK(stalled.event().name == "state");
  next = stalled.event();
  REQUIRE(next.name == "points");
  CHECK(moments(next).at(0) > latest_s + 3);
}

TEST_CASE("A viewer that takes nothing for its time is closed", "[threads]") {
  const Watched watched({.viewer_time = 500ms, .send_buffer_bytes = 4096}, {}, 100);
  Client stalled(watched, 4096);
  stalled.ask("GET", "/live");
  std::this_thread::sleep_for(2s);
  const auto until = std::chrono::steady_clock::now() + 2s;
  bool ended = false;
  while (!ended && std::chrono::steady_clock::now() < until) {
    ended = stalled.take() == 0;
  }
  CHECK(ended);
}

TEST_CASE("A viewer that is slow but takes something is not closed", "[threads]") {
  const Watched watched({.viewer_time = 500ms, .send_buffer_bytes = 4096}, {}, 100);
  std::this_thread::sleep_for(1s);  // there is more to begin with than it takes in its time
  Client slow(watched, 4096);
  slow.ask("GET", "/live");
  for (int i = 0; i < 25; ++i) {
    REQUIRE(slow.take(2000) > 0);
    std::this_thread::sleep_for(100ms);
  }
}

TEST_CASE("More viewers than there may be are told so", "[threads]") {
  const Watched watched({.viewers = 1});
  Client first(watched);
  first.ask("GET", "/live");
  CHECK(first.finds("retry"));
  Client second(watched);
  second.ask("GET", "/live");
  CHECK(second.line() == "HTTP/1.1 503 Service Unavailable\r");
  CHECK(second.finds("1 viewers watch already"));
}

TEST_CASE("Idle connections make room for who asks for something", "[threads]") {
  const Watched watched({.connections = 4, .request_time = 60s});
  std::vector<std::unique_ptr<Client>> idle;
  for (int i = 0; i < 20; ++i) {
    idle.push_back(std::make_unique<Client>(watched));
  }
  Client viewer(watched);
  viewer.ask("GET", "/");
  CHECK(viewer.line() == "HTTP/1.1 200 OK\r");
}

TEST_CASE("A request has its time in all, however its bytes come", "[threads]") {
  const Watched watched({.request_time = 300ms});
  Client slow(watched);
  slow.send("GET / HTTP/1.1\r\nX: ");
  const auto begin = std::chrono::steady_clock::now();
  std::thread dripping([&] {
    for (int i = 0; i < 20; ++i) {
      slow.send("x");
      std::this_thread::sleep_for(50ms);
    }
  });
  CHECK(slow.line().empty());
  const auto lasted = std::chrono::steady_clock::now() - begin;
  dripping.join();
  CHECK(lasted >= 250ms);
  CHECK(lasted < 950ms);
}

TEST_CASE("What is too long or no HTTP is refused", "[threads]") {
  const Watched watched;
  const auto answer_to = [&](const std::string& text) {
    Client client(watched);
    client.send(text);
    return client.line();
  };
  CHECK(answer_to("GET / HTTP/1.1\r\nX: " + std::string(20000, 'x')) ==
        "HTTP/1.1 431 Request Header Fields Too Large\r");
  CHECK(answer_to("POST /mark HTTP/1.1\r\nContent-Length: 100000000\r\n\r\n") ==
        "HTTP/1.1 413 Payload Too Large\r");
  CHECK(answer_to("\x16\x03\x01 hello\r\n\r\n") == "HTTP/1.1 400 Bad Request\r");
}

TEST_CASE("A slow action holds up nobody else", "[threads]") {
  const Watched watched;
  Client acting(watched);
  acting.post("/mark", R"({"text": "slow"})");
  Client viewer(watched);
  const auto begin = std::chrono::steady_clock::now();
  viewer.ask("GET", "/");
  CHECK(viewer.line() == "HTTP/1.1 200 OK\r");
  CHECK(std::chrono::steady_clock::now() - begin < 250ms);
  CHECK(acting.line() == "HTTP/1.1 200 OK\r");
}

TEST_CASE("The download of a large recording does not delay another viewer's events", "[threads]") {
  // 8 GB that take no room on the disk: as fast as it can be taken, for longer than the test lasts.
  const TemporaryFolder folder;
  const std::string path = folder.write("rec.csv", "");
  std::filesystem::resize_file(path, 8'000'000'000);
  std::ofstream(path, std::ios::app) << '\n';
  const Watched watched({}, path);
  std::vector<std::unique_ptr<Client>> taking;
  std::vector<std::thread> threads;
  std::atomic<bool> ended = false;
  std::atomic<std::uint64_t> taken = 0;
  for (int i = 0; i < 4; ++i) {
    taking.push_back(std::make_unique<Client>(watched));
    taking.back()->ask("GET", "/recording");
    threads.emplace_back([&, client = taking.back().get()] {
      while (const std::size_t count = ended ? 0 : client->take()) {
        taken += count;
      }
    });
  }
  Client viewer(watched);
  viewer.ask("GET", "/live");
  CHECK(viewer.finds("event: state"));
  std::chrono::steady_clock::duration longest{};
  for (int i = 0; i < 20; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    CHECK(viewer.finds("event: points"));
    longest = std::max(longest, std::chrono::steady_clock::now() - begin);
  }
  const std::uint64_t meanwhile = taken;
  ended = true;
  for (std::thread& thread : threads) {
    thread.join();
  }
  CHECK(meanwhile > 10'000'000);
  CHECK(meanwhile < 32'000'000'000);
  CHECK(longest < 500ms);
}

TEST_CASE("An action that fails says why", "[threads]") {
  const Watched watched;
  Client client(watched);
  client.post("/recording/stop", "");
  CHECK(client.line() == "HTTP/1.1 409 Conflict\r");
  CHECK(client.finds("\r"));
  CHECK(client.line() == R"({"error":"No recording is under way."})");
}

TEST_CASE("The server ends at once, whoever still watches", "[threads]") {
  auto watched = std::make_unique<Watched>();
  Client viewer(*watched);
  viewer.ask("GET", "/live");
  CHECK(viewer.finds("event: state"));
  Client idle(*watched);
  const auto begin = std::chrono::steady_clock::now();
  watched.reset();
  CHECK(std::chrono::steady_clock::now() - begin < 1s);
}

}  // namespace
