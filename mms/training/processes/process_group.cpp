#include "mms/training/processes/process_group.hpp"

#include <chrono>
#include <stdexcept>
#include <thread>

#include "mms/core/error.hpp"

#ifdef MMS_WITH_GLOO
#include <boost/asio/ip/tcp.hpp>
#include <torch/csrc/distributed/c10d/PrefixStore.hpp>
#include <torch/csrc/distributed/c10d/ProcessGroupGloo.hpp>
#include <torch/csrc/distributed/c10d/TCPStore.hpp>
#endif

namespace mms {

#ifdef MMS_WITH_GLOO
namespace {

using Gloo = c10d::ProcessGroupGloo;

std::string host_and_port(const ProcessPlace& place) {
  return place.address + ":" + std::to_string(place.port);
}

std::string name_of(const ProcessPlace& place) {
  return "process " + std::to_string(place.rank) + " of " + std::to_string(place.size);
}

/// The first line of an exception of torch or Gloo, without what both say about their sources.
std::string reason_of(const std::exception& fault) {
  const auto* torch_fault = dynamic_cast<const c10::Error*>(&fault);
  std::string text = torch_fault ? torch_fault->what_without_backtrace() : fault.what();
  text = text.substr(0, text.find('\n'));
  if (text.starts_with("[") && text.find("] ") != std::string::npos) {
    text = text.substr(text.find("] ") + 2);
  }
  return text;
}

constexpr std::chrono::milliseconds kPause{100};  ///< between two questions for others
constexpr std::chrono::seconds kAttempt{1};       ///< longest one to connect

/// Whether a process listens there. torch's own attempts print lines and cannot be stopped.
bool listens(const ProcessPlace& place) {
  boost::asio::ip::tcp::iostream stream;
  stream.expires_after(kAttempt);
  stream.connect(place.address, std::to_string(place.port));
  return stream.good();
}

/// Waits until `condition()`. @throws std::runtime_error with the reason
template <typename Condition>
void wait_for(const Condition& condition, std::chrono::steady_clock::time_point end,
              const std::function<bool()>& stop, const char* late) {
  while (!condition()) {
    if (std::chrono::steady_clock::now() >= end) throw std::runtime_error(late);
    if (stop && stop()) throw std::runtime_error("the wait was stopped");
    std::this_thread::sleep_for(kPause);
  }
}

c10::intrusive_ptr<c10d::Store> meet(const ProcessPlace& place, const std::function<bool()>& stop) {
  const auto end = std::chrono::steady_clock::now() + place.wait;
  c10d::TCPStoreOptions options;
  options.port = static_cast<std::uint16_t>(place.port);
  options.isServer = place.rank == 0 && !place.hosted_by_launcher;
  options.numWorkers = static_cast<std::size_t>(place.size);
  options.waitWorkers = false;  // torch would go on silently without those that are missing
  options.timeout = place.wait;
  if (!options.isServer) wait_for([&] { return listens(place); }, end, stop, "no process listens");
  c10::intrusive_ptr<c10d::Store> store = c10::make_intrusive<c10d::PrefixStore>(
      "mms/" + place.prefix, c10::make_intrusive<c10d::TCPStore>(place.address, options));
  store->set(std::to_string(place.rank), std::vector<std::uint8_t>{1});
  std::vector<std::string> all;
  for (int rank = 0; rank < place.size; ++rank) all.push_back(std::to_string(rank));
  wait_for([&] { return store->check(all); }, end, stop, "some have not started");
  return store;
}

bool is_loopback(const std::string& address) {
  return address == "localhost" || address == "::1" || address.starts_with("127.");
}

auto device_for(const ProcessPlace& place) {
  // The variable of torch for machines with several networks.
  const std::optional<std::string> interface = environment_variable("GLOO_SOCKET_IFNAME");
  if (interface) return Gloo::createDeviceForInterface(*interface);
  if (is_loopback(place.address)) return Gloo::createDeviceForHostname(place.address);
  return Gloo::createDefaultDevice();
}

}  // namespace

struct ProcessGroup::Connection {
  Connection(const ProcessPlace& place, const std::function<bool()>& stop) {
    const auto options = Gloo::Options::create(place.answer);
    options->devices.push_back(device_for(place));
    gloo = c10::make_intrusive<Gloo>(meet(place, stop), place.rank, place.size, options);
  }

  /// Does something together, and waits for it.
  template <typename Call>
  void together(const ProcessPlace& place, const Call& call) {
    try {
      call(*gloo)->wait();
    } catch (const std::exception& fault) {
      throw Error(name_of(place),
                  "another process has ended or cannot be reached: " + reason_of(fault),
                  "see its message; the last checkpoint is whole, and the same command for all "
                  "processes continues from it");
    }
  }

  c10::intrusive_ptr<Gloo> gloo;
};
#else
struct ProcessGroup::Connection {
  template <typename Call>
  void together(const ProcessPlace&, const Call&) {}
};
#endif

ProcessGroup::ProcessGroup() = default;

ProcessGroup::ProcessGroup(const ProcessPlace& place,
                           [[maybe_unused]] const std::function<bool()>& stop)
    : place_(place) {
  if (place.size == 1) return;
#ifdef MMS_WITH_GLOO
  try {
    connection_ = std::make_unique<Connection>(place, stop);
  } catch (const std::exception& fault) {
    throw Error(name_of(place),
                "not all processes have met at " + host_and_port(place) + ": " + reason_of(fault),
                "start all of them within " + std::to_string(place.wait.count()) +
                    " s; GLOO_SOCKET_IFNAME selects the network interface");
  }
#else
  throw ConfigError("WORLD_SIZE", "is " + std::to_string(place.size) + ", this build allows 1 only",
                    "a build with libgloo-dev has several processes");
#endif
}

ProcessGroup::~ProcessGroup() = default;

torch::Tensor ProcessGroup::sum(const torch::Tensor& values) {
  if (!connection_) return values;
  std::vector<torch::Tensor> total = {values.detach().to(torch::kCPU, values.scalar_type(),
                                                         /*non_blocking=*/false, /*copy=*/true,
                                                         at::MemoryFormat::Contiguous)};
  connection_->together(place_, [&](auto& gloo) { return gloo.allreduce(total); });
  return total[0].to(values.device());
}

network::ProcessSum ProcessGroup::as_sum() {
  if (!connection_) return {};
  return [this](const torch::Tensor& values) { return sum(values); };
}

std::string ProcessGroup::broadcast(const std::string& bytes) {
  if (!connection_) return bytes;
  std::vector<torch::Tensor> size = {torch::tensor(static_cast<std::int64_t>(bytes.size()))};
  connection_->together(place_, [&](auto& gloo) { return gloo.broadcast(size); });
  std::string all = bytes;
  all.resize(static_cast<std::size_t>(size[0].item<std::int64_t>()));
  std::vector<torch::Tensor> content = {
      torch::from_blob(all.data(), {static_cast<std::int64_t>(all.size())}, torch::kByte)};
  connection_->together(place_, [&](auto& gloo) { return gloo.broadcast(content); });
  return all;
}

}  // namespace mms
