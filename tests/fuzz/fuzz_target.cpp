#include "tests/fuzz/fuzz_target.hpp"

#include <unistd.h>

#include <cstring>
#include <fstream>
#include <random>

#include "mms/io/text/files.hpp"
#include "mms/io/text/temporary_path.hpp"

namespace mms::testing {
namespace fs = std::filesystem;
namespace {

using Random = std::mt19937;

/// What numbers in texts are replaced by.
constexpr std::string_view kWords[] = {"nan", "-1", "1e999", "99999999999999999999", "",
                                       "inf", "0",  "-0",    "2147483648",           "\xff"};
/// What numbers in binary files are replaced by.
constexpr std::uint64_t kNumbers[] = {0,
                                      1,
                                      0x7F,
                                      0xFF,
                                      0x7FFF,
                                      0xFFFF,
                                      0x7FFF'FFFF,
                                      0xFFFF'FFFF,
                                      0x7FFF'FFFF'FFFF'FFFF,
                                      0xFFFF'FFFF'FFFF'FFFF};

/// A place in [0, size], half of the time near the beginning, where headers are.
std::size_t place_in(std::size_t size, Random& random) {
  constexpr std::size_t kHeader = 256;
  if (random() % 2 == 0) size = std::min(size, kHeader);
  return random() % (size + 1);
}

void replace_number(std::string& bytes, std::size_t at, Random& random) {
  const auto digit = bytes.find_first_of("0123456789", at);
  if (digit == std::string::npos) return;
  const auto end = bytes.find_first_not_of("0123456789.", digit);
  bytes.replace(digit, std::min(end, bytes.size()) - digit, kWords[random() % std::size(kWords)]);
}

void overwrite_number(std::string& bytes, std::size_t at, Random& random) {
  const std::uint64_t number = kNumbers[random() % std::size(kNumbers)];
  const std::size_t size = std::size_t{1} << (random() % 4);
  if (at + size <= bytes.size()) std::memcpy(bytes.data() + at, &number, size);
}

void damage(std::string& bytes, const std::string& other, Random& random) {
  const std::size_t at = place_in(bytes.size(), random);
  const std::size_t length = random() % 64;
  switch (random() % 9) {
    case 0:
      if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ (1U << random() % 8));
      break;
    case 1:
      if (at < bytes.size()) bytes[at] = static_cast<char>(random());
      break;
    case 2:
    case 3:
      overwrite_number(bytes, at, random);
      break;
    case 4:
      replace_number(bytes, at, random);
      break;
    case 5:
      bytes.erase(at, length);
      break;
    case 6:
      bytes.insert(at, bytes.substr(place_in(bytes.size(), random), length));
      break;
    case 7:
      bytes.resize(at);
      break;
    default:
      bytes = bytes.substr(0, at) + other.substr(std::min(at, other.size()));
  }
}

}  // namespace

std::vector<FuzzTarget> fuzz_targets() {
  std::vector<FuzzTarget> all = file_targets();
  for (const auto& more :
       {map_targets(), result_targets(), recording_targets(), network_targets()}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

const fs::path& fuzz_folder() {
  const fs::path memory = "/dev/shm";  // much faster than a disk, where it is
  static const TemporaryPath folder(
      (fs::is_directory(memory) ? memory : fs::temp_directory_path()) /
      ("mms_fuzz_" + std::to_string(::getpid())));
  fs::create_directories(folder.path());
  return folder.path();
}

fs::path as_file(std::string_view bytes, const std::string& name) {
  fs::path file = fuzz_folder() / name;
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
  return file;
}

std::string bytes_of(const std::string& name, const std::function<void(const fs::path&)>& write) {
  const fs::path file = fuzz_folder() / name;
  write(file);
  return read_file(file);
}

std::string damaged(const std::vector<std::string>& seeds, unsigned number) {
  Random random(number);
  std::string bytes = seeds[number % seeds.size()];
  const std::string& other = seeds[random() % seeds.size()];
  for (auto changes = 1 + random() % 6; changes > 0; --changes) {
    damage(bytes, other, random);
  }
  return bytes;
}

}  // namespace mms::testing
