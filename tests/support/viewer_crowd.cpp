// usage: viewer_crowd PORT CLIENTS SECONDS: viewers of a local server that connect for some
// seconds, send commands, garbage and too long messages, read slowly, and disconnect without a
// closing handshake.

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/server/client.hpp"

namespace {

using mms::testing::ViewerClient;
using Clock = std::chrono::steady_clock;

struct Counts {
  std::atomic<long> visits = 0;
  std::atomic<long> refused = 0;
  std::atomic<long> messages = 0;
  std::atomic<long> bytes = 0;
  std::atomic<long> garbage = 0;
};

std::string random_text(std::mt19937& random, std::size_t size) {
  std::string text(size, '\0');
  for (char& c : text) c = static_cast<char>(random());
  return text;
}

void send_something(ViewerClient& client, std::mt19937& random, Counts& counts) {
  static const std::vector<std::string> kCommands = {
      R"({"type":"pause"})", R"({"type":"play"})", R"({"type":"seek","frame":3})",
      R"({"type":"step"})", R"({"type":"want","points":true,"image":true,"map":true})"};
  const auto kind = random() % 10;
  if (kind < 6) return client.send(kCommands[random() % kCommands.size()]);
  ++counts.garbage;
  client.send(random_text(random, kind < 9 ? random() % 300 : 5000), true);
}

void visit(std::uint16_t port, std::mt19937& random, Counts& counts) {
  if (random() % 8 == 0) {
    ++counts.garbage;
    mms::testing::send_raw(port, random_text(random, random() % 20000) + "\r\n\r\n", "HTTP");
    return;
  }
  ViewerClient client(port);
  ++counts.visits;
  const bool slow = random() % 4 == 0;
  const auto end = Clock::now() + std::chrono::milliseconds(random() % 4000);
  while (Clock::now() < end) {
    const auto message = client.read_bytes();
    if (!message) return;
    ++counts.messages;
    counts.bytes += static_cast<long>(message->size());
    if (random() % 20 == 0) send_something(client, random, counts);
    if (slow) std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  client.drop();
}

void connect_repeatedly(std::uint16_t port, unsigned seed, Clock::time_point end, Counts& counts) {
  std::mt19937 random(seed);
  while (Clock::now() < end) {
    try {
      visit(port, random, counts);
    } catch (const std::exception&) {
      ++counts.refused;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return std::fprintf(stderr, "usage: viewer_crowd PORT CLIENTS SECONDS\n"), 2;
  const auto port = static_cast<std::uint16_t>(std::atoi(argv[1]));
  const Clock::time_point end = Clock::now() + std::chrono::seconds(std::atoi(argv[3]));
  Counts counts;
  std::vector<std::thread> crowd;
  for (int i = 0; i < std::atoi(argv[2]); ++i) {
    crowd.emplace_back(connect_repeatedly, port, static_cast<unsigned>(i), end, std::ref(counts));
  }
  for (std::thread& client : crowd) client.join();
  std::printf("%ld visits, %ld refused, %ld messages of %.1f MB, %ld times garbage\n",
              counts.visits.load(), counts.refused.load(), counts.messages.load(),
              static_cast<double>(counts.bytes) / 1e6, counts.garbage.load());
  return 0;
}
