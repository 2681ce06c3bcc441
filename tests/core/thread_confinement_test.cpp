#include "mms/core/thread_confinement.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

bool is_owner_elsewhere(const ThreadConfinement& confinement) {
  bool is_owner = false;
  std::thread([&] { is_owner = confinement.is_owner(); }).join();
  return is_owner;
}

TEST(ThreadConfinement, FirstThreadOwnsUntilRelease) {
  ThreadConfinement confinement;
  EXPECT_TRUE(confinement.is_owner());
  EXPECT_TRUE(confinement.is_owner());
  EXPECT_FALSE(is_owner_elsewhere(confinement));
  confinement.release();
  EXPECT_TRUE(is_owner_elsewhere(confinement));
  EXPECT_FALSE(confinement.is_owner());
}

TEST(ThreadConfinement, CopyHasNoOwner) {
  ThreadConfinement confinement;
  ASSERT_TRUE(confinement.is_owner());
  EXPECT_TRUE(is_owner_elsewhere(ThreadConfinement(confinement)));
}

}  // namespace
}  // namespace mms
