// The platform: files and processes as the rest of the library sees them on any system.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#ifdef _WIN32
#ifndef NOMINMAX
#define NOMINMAX
#endif
#include <windows.h>
#endif

#include "core/platform/files.hpp"
#include "core/platform/number_text.hpp"
#include "core/platform/process.hpp"
#include "support/sanitized.hpp"

namespace frond::test {
namespace platform_tests {

struct Files : ::testing::Test {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() /
        ("frond_platform_" + std::to_string(std::chrono::steady_clock::now().time_since_epoch().count()));
    void SetUp() override { std::filesystem::create_directory(folder); }
    void TearDown() override { std::filesystem::remove_all(folder); }
    std::string at(const char* name) const { return (folder / std::filesystem::u8path(name)).generic_u8string(); }
};

TEST_F(Files, AreReadAsTheyWereWritten) {
    const std::string wanted("a\r\nb\0c\xff", 7), path = at("Gr\xc3\xbcn \xe8\x91\x89.obj");
    std::string bytes, error;
    ASSERT_TRUE(write_file(path, wanted, error)) << error;
    ASSERT_TRUE(read_file(path, 100, bytes, error)) << error;
    EXPECT_EQ(bytes, wanted);
    ASSERT_TRUE(read_file(path, 3, bytes, error)) << error;
    EXPECT_EQ(bytes, "a\r\n");
    EXPECT_TRUE(is_regular_file(path));
    EXPECT_EQ(status_of(path).size, 7u);
    EXPECT_EQ(real_path(at("../") + folder.filename().u8string() + "/Gr\xc3\xbcn \xe8\x91\x89.obj"), real_path(path));
}

TEST_F(Files, ThatAreMissingHaveTheSystemsWords) {
    std::string bytes, error;
    EXPECT_FALSE(read_file(at("none"), 100, bytes, error));
    EXPECT_EQ(error, "No such file or directory");
    EXPECT_EQ(status_of(at("none")).error, error);
    error.clear();
    EXPECT_FALSE(write_file(at("none/file"), "a", error));
    EXPECT_EQ(error, "No such file or directory");
    EXPECT_EQ(real_path(at("none")), "");
    EXPECT_EQ(real_path(std::string(at("a") + '\0')), "");
    EXPECT_TRUE(entries_of(at("none"), 10).empty());
}

TEST_F(Files, AreListedWithoutFollowingLinks) {
    std::string error;
    ASSERT_TRUE(write_file(at("file"), "a", error));
    std::filesystem::create_directory(folder / "below");
#ifndef _WIN32
    std::filesystem::create_directory_symlink(folder / "below", folder / "link");
#else
    std::filesystem::create_directory(folder / "beside");
#endif
    int regular = 0, folders = 0;
    for (const FolderEntry& entry : entries_of(folder.u8string(), 10)) {
        regular += entry.is_regular;
        folders += entry.is_folder;
    }
    EXPECT_EQ(entries_of(folder.u8string(), 10).size(), 3u);
    EXPECT_EQ(regular, 1);
#ifndef _WIN32
    EXPECT_EQ(folders, 1);
#endif
    EXPECT_EQ(entries_of(folder.u8string(), 2).size(), 2u);
}

TEST(Paths, AreCutAtTheirLastSeparator) {
    EXPECT_EQ(file_name("a/b.obj"), "b.obj");
    EXPECT_EQ(file_name("b.obj"), "b.obj");
    EXPECT_EQ(folder_of("a/b.obj"), "a");
    EXPECT_EQ(folder_of("/b.obj"), "/");
    EXPECT_EQ(folder_of("b.obj"), ".");
    EXPECT_TRUE(has_ending("a.OBJ", ".obj"));
    EXPECT_FALSE(has_ending(".obj", ".obj"));
    EXPECT_FALSE(has_ending("obj", ".obj"));
}

TEST(NumberTexts, AreReadInAnyLocale) {
    const std::string text = "-1.5e3,7";
    double value = 0;
    EXPECT_EQ(read_number(text.data(), text.data() + text.size(), value).ptr, text.data() + 6);
    EXPECT_EQ(value, -1500);
}

// Wine holds no job to its limits; Windows does. Wine's system library has a function that tells of it.
#ifdef _WIN32
const bool IS_WINE = GetProcAddress(GetModuleHandleA("ntdll.dll"), "wine_get_version") != nullptr;
#else
constexpr bool IS_WINE = false;
#endif
// Nor does qemu hold a program to its memory, or tell one program that another cannot be started.
#ifdef FROND_TEST_QEMU
constexpr bool IS_QEMU = true;
#else
constexpr bool IS_QEMU = false;
#endif

// Runs tests/support/child.cpp and returns how it ended.
ChildEnd run(const std::vector<std::string>& words, std::string& output, std::string& errors,
             const ProcessLimits& limits = {}) {
    Child child(FROND_TEST_CHILD, words, limits);
    while (child.hear(10000, output, errors)) {
    }
    return child.end(false);
}

TEST(Children, AreHeardToTheirEnd) {
    std::string output, errors;
    EXPECT_EQ(run({"talk", "said", "200000"}, output, errors).how, ChildEnd::EXITED);
    EXPECT_EQ(output, std::string(200000, 'x'));
    EXPECT_EQ(errors, "said");
}

TEST(Children, HearTheirWordsAsTheyWereSaid) {
    for (const char* word : {"", "a b", "\"", "a\\", "a\\\"b c\\\\", "Gr\xc3\xbcn"}) {
        std::string output, errors;
        run({"talk", word, "0"}, output, errors);
        EXPECT_EQ(errors, word);
    }
}

TEST(Children, TellOfWhatTheyDiedOf) {
    std::string output, errors;
    const ChildEnd end = run({"crash"}, output, errors);
    EXPECT_EQ(end.how, ChildEnd::CRASHED);
#ifdef _WIN32
    EXPECT_EQ(end.words, "code 0xc0000005");
#else
    EXPECT_EQ(end.words, "signal 11");
#endif
}

TEST(Children, AreEndedWhenTheirTimeIsUp) {
    if (IS_WINE) GTEST_SKIP();
    std::string output, errors;
    ProcessLimits limits;
    limits.cpu_seconds = 1;
    EXPECT_EQ(run({"spin", "1"}, output, errors, limits).how, ChildEnd::OUT_OF_CPU_TIME);
}

TEST(Children, GetNoMoreMemoryThanTheyMay) {
    std::string output, errors;
    ProcessLimits limits;
    limits.memory_mib = 256;
    run({"ask", "64", "256"}, output, errors, limits);
    EXPECT_EQ(output, "got it");
    output.clear();
    run({"ask", "512", "256"}, output, errors, limits);
    EXPECT_EQ(output, SANITIZED || IS_WINE || IS_QEMU ? "got it" : "got none");
}

TEST(Children, AreStoppedWithTheirObject) {
    const auto start = std::chrono::steady_clock::now();
    std::string output, errors;
    {
        Child child(FROND_TEST_CHILD, {"wait"}, {});
        while (output.empty()) ASSERT_TRUE(child.hear(10000, output, errors));
    }
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 50);
}

TEST(Children, ThatCannotBeStartedAreAnError) {
    EXPECT_FALSE(is_program("/no/such/program"));
    EXPECT_FALSE(is_program(FROND_SOURCE_DIR));
    EXPECT_TRUE(is_program(FROND_TEST_CHILD));
    if (IS_QEMU) GTEST_SKIP();
    EXPECT_THROW(Child("/no/such/program", {}, {}), std::system_error);
}

}  // namespace platform_tests
}  // namespace frond::test
