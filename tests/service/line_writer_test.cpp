#include "service/line_writer.h"

#include <array>
#include <chrono>
#include <fcntl.h>
#include <functional>
#include <string>
#include <thread>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/unique_fd.h"

namespace farhorizon {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

struct Pipe {
  Pipe() {
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
    reading = UniqueFd(ends[0]);
    writing = UniqueFd(ends[1]);
  }
  // Reads until `enough` of the text, or for ten seconds.
  std::string Read(const std::function<bool(const std::string&)>& enough) {
    ::fcntl(reading.get(), F_SETFL, O_NONBLOCK);
    std::string text;
    for (int i = 0; i < 1000 && !enough(text); ++i) {
      std::array<char, 65536> piece{};
      const ssize_t size = ::read(reading.get(), piece.data(), piece.size());
      if (size > 0) {
        text.append(piece.data(), static_cast<std::size_t>(size));
      } else {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
    }
    return text;
  }
  std::string ReadUntil(const std::string& last) {
    return Read([&](const std::string& text) { return text.find(last) != std::string::npos; });
  }
  UniqueFd reading;
  UniqueFd writing;
};

std::string Lost(std::int64_t count) { return "lost " + std::to_string(count) + "\n"; }

TEST(LineWriter, WritesLinesInTheirOrderLongOnesToo) {
  Pipe pipe;
  const std::string long_line(100'000, 'x');
  LineWriter writer(pipe.writing.get(), 1 << 20, Lost);
  writer.Write("one\n");
  writer.Write(long_line + "\n");
  writer.Write("three\n");
  EXPECT_EQ(pipe.ReadUntil("three\n"), "one\n" + long_line + "\nthree\n");
  EXPECT_EQ(writer.dropped(), 0);
}

TEST(LineWriter, WhereNobodyReadsDropsCountsAndSaysSo) {
  Pipe pipe;
  const std::string line = std::string(999, 'x') + "\n";
  LineWriter writer(pipe.writing.get(), 100'000, Lost);
  for (int i = 0; i < 2000; ++i) writer.Write(line);  // 2 MB: the pipe takes 64 KiB of them
  EXPECT_GT(writer.dropped(), 1000);
  const auto dropped = std::to_string(writer.dropped());
  const std::size_t kept = line.size() * static_cast<std::size_t>(2000 - writer.dropped());
  std::string text = pipe.Read([&](const std::string& read) { return read.size() >= kept; });
  EXPECT_EQ(text.size(), kept);
  EXPECT_THAT(text, Not(HasSubstr("lost")));
  writer.Write("last\n");
  text = pipe.ReadUntil("last\n");
  EXPECT_THAT(text, StartsWith("lost " + dropped + "\nlast\n"));
}

TEST(LineWriter, EndsThoughNobodyReads) {
  Pipe pipe;
  const auto begin = std::chrono::steady_clock::now();
  {
    LineWriter writer(pipe.writing.get(), 1 << 20, Lost);
    for (int i = 0; i < 1000; ++i) writer.Write(std::string(999, 'x') + "\n");
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

TEST(LineWriter, WritesWhatItKeepsBeforeItEnds) {
  Pipe pipe;
  {
    LineWriter writer(pipe.writing.get(), 1 << 20, Lost);
    for (int i = 0; i < 10; ++i) writer.Write("line\n");
    writer.Write("last\n");
  }
  EXPECT_THAT(pipe.ReadUntil("last\n"), HasSubstr("line\nlast\n"));
}

TEST(LineWriter, GoesOnWhereItsDescriptorCannotBeWritten) {
  UniqueFd full(::open("/dev/full", O_WRONLY | O_CLOEXEC));
  ASSERT_TRUE(full);
  LineWriter writer(full.get(), 1 << 20, Lost);
  writer.Write("one\n");
  for (int i = 0; i < 1000 && writer.dropped() == 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_EQ(writer.dropped(), 1);
}

}  // namespace
}  // namespace farhorizon
