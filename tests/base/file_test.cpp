#include <filesystem>

#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/base/file.h"
#include "support/support.h"

namespace limn::test {
namespace {

std::size_t files_in(const TemporaryFolder& folder)
{
    return std::size_t(std::distance(std::filesystem::directory_iterator(folder.path()), {}));
}

std::string error_of(auto&& action)
{
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(WriteFile, ReplacesAFileAndLeavesNothingBeside)
{
    const TemporaryFolder folder;
    write_file(folder / "a", "first, and longer");
    write_file(folder / "a", "second");
    EXPECT_EQ(read_text(folder / "a"), "second");
    EXPECT_EQ(files_in(folder), 1u);
}

TEST(WriteFile, KeepsThePermissionsOfWhatItReplaces)
{
    const TemporaryFolder folder;
    write_file(folder / "a", "1");
    std::filesystem::permissions(folder / "a", std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    write_file(folder / "a", "2");
    EXPECT_EQ(std::filesystem::status(folder / "a").permissions(), std::filesystem::perms(0600));
}

TEST(WriteFile, FollowsALink)
{
    const TemporaryFolder folder;
    write_file(folder / "real", "1");
    std::filesystem::create_symlink("real", folder / "link");
    write_file(folder / "link", "2");
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_EQ(read_text(folder / "real"), "2");
}

TEST(WriteFile, NamesTheFileAndTheCauseWhereItCannotWrite)
{
    const TemporaryFolder folder;
    const std::string missing = (folder / "missing/a").string();
    EXPECT_EQ(error_of([&] { write_file(missing, "1"); }), missing + ": cannot be written: No such file or directory");
    EXPECT_EQ(error_of([&] { write_file(folder.path(), "1"); }), folder.path().string() + ": cannot be written: Is a directory");
    EXPECT_EQ(error_of([] { write_file("/dev/full", "1"); }), "/dev/full: cannot be written: No space left on device");
    EXPECT_EQ(files_in(folder), 0u);
}

TEST(ReadFile, NamesTheFileAndTheCauseWhereItCannotRead)
{
    const TemporaryFolder folder;
    const std::string missing = (folder / "missing").string();
    EXPECT_EQ(error_of([&] { read_file(missing); }), missing + ": cannot be opened: No such file or directory");
    EXPECT_EQ(error_of([&] { read_file(folder.path()); }), folder.path().string() + ": is a directory, not a file");
}

TEST(ReadFile, ReadsWhatWasWritten)
{
    const TemporaryFolder folder;
    const std::string bytes("a\0b\n\xff", 5);
    write_file(folder / "a", bytes);
    EXPECT_EQ(read_file(folder / "a"), bytes);
    write_file(folder / "empty", "");
    EXPECT_EQ(read_file(folder / "empty"), "");
}

TEST(FileEnding, IsInLowerCaseWithoutItsDot)
{
    EXPECT_EQ(file_ending("a/b.PLY"), "ply");
    EXPECT_EQ(file_ending("a.tar.gz"), "gz");
    EXPECT_EQ(file_ending("a.b/c"), "");
    EXPECT_EQ(file_ending("-"), "");
}

} // namespace
} // namespace limn::test
