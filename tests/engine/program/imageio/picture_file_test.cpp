// Writing pictures and planes to files.
#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "engine/program/imageio/picture.h"
#include "engine/program/import/child_process.h"

namespace tessera::picture_file_test {
using namespace program;
namespace {

namespace fs = std::filesystem;

class PictureFile : public testing::Test {
 protected:
  PictureFile() : folder_(fs::temp_directory_path() / ("tessera_picture_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~PictureFile() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  static std::string content(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  static std::string message_of(const Picture& picture, const std::string& file) {
    try {
      write_picture(picture, file);
    } catch (const Error& error) {
      return error.what();
    }
    return "(no error)";
  }
  std::size_t files_in_folder() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

Picture two_pixels() {
  Picture picture(2, 1);
  picture.rgba = {255, 0, 10, 255, 1, 2, 3, 255};
  return picture;
}

TEST_F(PictureFile, WritesNetpbmAndRawByteForByte) {
  const Picture picture = two_pixels();
  write_picture(picture, path("a.ppm"));
  EXPECT_EQ(content(path("a.ppm")), std::string("P6\n2 1\n255\n\xff\0\x0a\x01\x02\x03", 17));
  write_picture(picture, path("a.PGM"));
  EXPECT_EQ(content(path("a.PGM")),
            std::string("P5\n2 1\n255\n\x4e\x02", 13));  // 0.30 * 255 + 0.11 * 10 = 77.6
  write_picture(picture, path("a.raw"));
  EXPECT_EQ(content(path("a.raw")), std::string("\xff\0\x0a\xff\x01\x02\x03\xff", 8));
  EXPECT_EQ(files_in_folder(), 3u);
}

TEST_F(PictureFile, PlanePbmClearsPaddingBits) {
  // 2 rows of 10 pixels, 3 bytes apart.
  const std::array<std::uint8_t, 6> bits{0xa5, 0xff, 0x77, 0x01, 0xff, 0x77};
  write_plane({.bits = bits.data(), .width = 10, .height = 2, .stride_bytes = 3}, path("plane.pbm"));
  EXPECT_EQ(content(path("plane.pbm")), "P4\n10 2\n\xa5\xc0\x01\xc0");
}

TEST_F(PictureFile, ReplacesFilesAtomically) {
  write_picture(two_pixels(), path("a.ppm"));
  write_picture(Picture(1, 1), path("a.ppm"));
  EXPECT_EQ(content(path("a.ppm")).size(), 14u);

  // A limit on the file size simulates a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before;
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{.rlim_cur = 100, .rlim_max = before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  const std::string message = message_of(Picture(100, 100), path("a.ppm"));
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_NE(message.find("File too large"), std::string::npos) << message;
  EXPECT_EQ(content(path("a.ppm")).size(), 14u);
  EXPECT_EQ(files_in_folder(), 1u);
}

TEST_F(PictureFile, KeepsSymbolicLinks) {
  write_picture(Picture(1, 1), path("real.ppm"));
  fs::create_symlink("real.ppm", folder_ / "link.ppm");
  write_picture(two_pixels(), path("link.ppm"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.ppm"));
  EXPECT_EQ(content(path("real.ppm")).size(), 17u);
  fs::create_symlink("link.ppm", folder_ / "to_link.ppm");
  fs::remove(folder_ / "real.ppm");
  write_picture(two_pixels(), path("to_link.ppm"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "to_link.ppm") && fs::is_symlink(folder_ / "link.ppm"));
  EXPECT_EQ(content(path("real.ppm")).size(), 17u) << "links to a missing file";
}

// The target of a link in /proc is not a path.
TEST_F(PictureFile, WritesDirectlyToOpenFiles) {
  const int opened = ::open(path("a.ppm").c_str(), O_RDWR | O_CREAT, 0600);
  ASSERT_GE(opened, 0);
  fs::remove(path("a.ppm"));
  fs::create_symlink("/dev/fd/" + std::to_string(opened), folder_ / "link.ppm");
  write_picture(two_pixels(), path("link.ppm"));
  char written[32];
  EXPECT_EQ(::pread(opened, written, sizeof written, 0), 17);
  ::close(opened);
  EXPECT_EQ(files_in_folder(), 1u);
}

TEST_F(PictureFile, NamesUnwritableFiles) {
  const Picture picture(1, 1);
  EXPECT_NE(message_of(picture, path("no/folder/a.ppm")).find("there is no folder"), std::string::npos);
  EXPECT_NE(message_of(picture, path("noending")).find("no extension"), std::string::npos);
  EXPECT_NE(message_of(picture, path("a.pbm")).find(".ppm"), std::string::npos);
  fs::create_directories(folder_ / "folder.ppm");
  EXPECT_NE(message_of(picture, path("folder.ppm")).find("Is a directory"), std::string::npos);
  fs::create_symlink("round.ppm", folder_ / "round.ppm");
  EXPECT_NE(message_of(picture, path("round.ppm")).find("Too many levels of symbolic links"),
            std::string::npos);
  if (fs::exists("/dev/full")) {
    fs::create_symlink("/dev/full", folder_ / "full.ppm");
    EXPECT_NE(message_of(picture, path("full.ppm")).find("No space left"), std::string::npos);
  }
}

// Runs as an ordinary user, because root may write everywhere.
TEST_F(PictureFile, ReportsReadOnlyFolderWithoutLoss) {
  write_picture(two_pixels(), path("old.ppm"));
  const std::string before = content(path("old.ppm"));
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec | fs::perms::group_read |
                               fs::perms::group_exec | fs::perms::others_read | fs::perms::others_exec);
  const std::string messages = run_in_child("writing", {}, [&] {
    if (::geteuid() == 0 && ::setuid(65534) != 0) return std::string("setuid failed");
    return message_of(Picture(3, 3), path("new.ppm")) + "\n" + message_of(Picture(3, 3), path("old.ppm"));
  });
  fs::permissions(folder_, fs::perms::owner_all);
  const std::string first = messages.substr(0, messages.find('\n'));
  EXPECT_TRUE(first.find("new.ppm") != std::string::npos &&
              first.find("Permission denied") != std::string::npos)
      << messages;
  EXPECT_TRUE(messages.find("old.ppm") != std::string::npos) << messages;
  EXPECT_EQ(content(path("old.ppm")), before);
  EXPECT_EQ(files_in_folder(), 1u);
}

}  // namespace
}  // namespace tessera::picture_file_test
