#include "mms/training/processes/process_group.hpp"

#include <ATen/Parallel.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cmath>
#include <future>

#include "mms/core/error.hpp"
#include "mms/io/weights/safetensors.hpp"
#include "mms/segmentation/weights/int8_weights.hpp"
#include "mms/training/run/trainer.hpp"
#include "mms/training/run/training_run.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/training/bars.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;
using testing::small_training;
using testing::TempFolder;
using testing::write_bars;

constexpr const char* kWeights = MMS_SOURCE_DIR "/weights/nano.safetensors";
constexpr int kSteps = 20;

int free_port() {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  EXPECT_EQ(bind(socket, reinterpret_cast<sockaddr*>(&address), size), 0);
  EXPECT_EQ(getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size), 0);
  close(socket);
  return ntohs(address.sin_port);
}

/// Places of two processes, which are threads here.
std::array<ProcessPlace, 2> two_places() {
  ProcessPlace first;
  first.size = 2;
  first.address = "127.0.0.1";
  first.port = free_port();
  first.wait = std::chrono::seconds(30);
  ProcessPlace second = first;
  second.rank = 1;
  return {first, second};
}

/// Results of a function of the group in two processes.
template <typename Function>
auto in_both(const Function& function) {
  std::array<std::future<std::invoke_result_t<Function, ProcessGroup&>>, 2> results;
  const auto places = two_places();
  for (std::size_t i = 0; i < 2; ++i) {
    results[i] = std::async(std::launch::async, [&function, place = places[i]] {
      at::set_num_threads(1);
      ProcessGroup group(place);
      return function(group);
    });
  }
  auto first = results[0].get();
  return std::array{std::move(first), results[1].get()};
}

TEST(ProcessGroup, OneProcessNeedsNoOthers) {
  ProcessGroup alone;
  EXPECT_TRUE(alone.is_first());
  EXPECT_EQ(alone.sum(torch::tensor(3)).item<int>(), 3);
  EXPECT_EQ(alone.broadcast("text"), "text");
  EXPECT_FALSE(alone.as_sum());
}

TEST(ProcessGroup, AddsTensorsAndSharesBytes) {
  const auto results = in_both([](ProcessGroup& group) {
    const torch::Tensor own = torch::full({2, 3}, group.is_first() ? 1.5 : 2.0);
    const torch::Tensor sum = group.sum(own);
    EXPECT_TRUE(torch::equal(own, torch::full({2, 3}, group.is_first() ? 1.5 : 2.0)));
    EXPECT_EQ(group.sum(torch::tensor(std::int64_t{5})).item<std::int64_t>(), 10);
    EXPECT_EQ(group.broadcast(group.is_first() ? "of the first" : "of the other one"),
              "of the first");
    EXPECT_EQ(group.broadcast(""), "");
    return sum;
  });
  for (const torch::Tensor& sum : results) EXPECT_TRUE(torch::equal(sum, torch::full({2, 3}, 3.5)));
}

TEST(ProcessGroup, ErrorSaysThatAnotherProcessEnded) {
  const auto messages = in_both([](ProcessGroup& group) -> std::string {
    if (!group.is_first()) return "";
    return message_of<Error>([&] { group.sum(torch::ones(1)); });
  });
  expect_in("process 0 of 2: another process has ended or cannot be reached: ", messages[0]);
  expect_in("the last checkpoint is whole", messages[0]);
}

TEST(ProcessGroup, ErrorSaysThatOthersDidNotStart) {
  ProcessPlace place = two_places()[0];
  place.wait = std::chrono::seconds(1);
  expect_in("process 0 of 2: not all processes have met at 127.0.0.1:",
            message_of<Error>([&] { ProcessGroup group(place); }));
}

/// The first process waits for the others, the second one for the first.
TEST(ProcessGroup, WaitForOthersCanBeStopped) {
  for (const ProcessPlace& place : two_places()) {
    SCOPED_TRACE(place.rank);
    int asked = 0;
    expect_in("the wait was stopped",
              message_of<Error>([&] { ProcessGroup group(place, [&] { return ++asked == 3; }); }));
    EXPECT_EQ(asked, 3);
  }
}

/// Losses of each step, and the averaged weights at the end.
struct Trained {
  std::vector<torch::Tensor> losses;
  std::map<std::string, torch::Tensor> weights;
};

Trained trained(const SampleStore& store, const TrainingConfig& config, ProcessGroup& group) {
  Trainer trainer(config, group);
  if (group.is_first()) {
    trainer.initialise(from_bytes(read_safetensors(kWeights), kWeights), kWeights);
  }
  trainer.share_state();
  Trained result;
  for (int step = 0; step < kSteps; ++step) {
    const Batch batch =
        make_batch(store, config, step, {.number = group.place().rank, .parts = group.size()});
    result.losses.push_back(group.sum(trainer.step(batch)));
  }
  for (const auto& [name, tensor] : network::named_tensors(*trainer.average())) {
    result.weights.emplace(name, tensor.clone());
  }
  return result;
}

/// Largest difference relative to the largest value.
double difference(const torch::Tensor& a, const torch::Tensor& b) {
  const double largest = b.abs().max().item<double>();
  return (a - b).abs().max().item<double>() / std::max(largest, 1e-6);
}

/// Two processes that divide the batch do the steps of one process with the whole batch.
TEST(ProcessGroup, TwoProcessesTrainAsOneWithTheWholeBatch) {
  const TempFolder folder;
  write_bars(folder.path(), 8);
  TrainingConfig config = small_training(folder.path(), 4 * kSteps);
  config.network = NetworkConfig();
  config.network.long_side = 128;
  config.network.short_side = 96;
  config.augmentation.noise = 1.0;  // without it batch norms divide by nearly nothing
  config.schedule = {
      .images = 4 * kSteps, .batch = 4, .learning_rate = 1e-4, .warm_up = 5, .kept_statistics = 3};
  const SampleStore store(config.data, training_classes(), config.cache_side);
  at::set_num_threads(1);
  ProcessGroup alone;
  const Trained one = trained(store, config, alone);
  const auto both = in_both([&](ProcessGroup& group) { return trained(store, config, group); });
  constexpr double kTolerance = 1e-5;
  for (std::size_t step = 0; step < kSteps; ++step) {
    EXPECT_LT(difference(both[0].losses[step], one.losses[step]), kTolerance) << "step " << step;
  }
  double largest = 0.0;
  for (const auto& [name, tensor] : one.weights) {
    EXPECT_TRUE(torch::equal(both[0].weights.at(name), both[1].weights.at(name))) << name;
    if (!tensor.is_floating_point()) continue;
    const double error = difference(both[0].weights.at(name), tensor);
    EXPECT_LT(error, kTolerance) << name;
    largest = std::max(largest, error);
  }
  EXPECT_GT((both[0].losses.front() - both[0].losses.back()).abs().max().item<double>(), 0.01)
      << "nothing was learned";
  RecordProperty("largest_difference", std::to_string(largest));
}

}  // namespace
}  // namespace mms
