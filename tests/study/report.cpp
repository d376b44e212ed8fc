#include "study/report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace frond::study;

namespace report_tests {

// Returns two points, one of which failed with a text that needs quoting.
Result little_result() {
    Result result = {&find_problem("swing"), {}, {}, {"The reference, as \"refined\"."}};
    Point good = {"bdf2", result.problem->baseline(), {}, "", false, false};
    good.outcome.error = 0.0125;
    good.outcome.cpu_per_second = 0.004;
    good.outcome.values = {{"rms, of all", 0.0125, 0}, {"a|b", 2, NAN}};
    Point bad = {"symplectic_euler", result.problem->baseline(), {}, "unstable, \"as known\"", false, false};
    result.points = {good, bad};
    good.series = "";
    result.changes = {good};
    mark_front(result.points);
    return result;
}

// Returns the fields of a line without quotes.
std::vector<std::string> fields_of(const std::string& line) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (size_t i = 0; i < line.size(); i++) {
        if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
            fields.back() += line[++i];
        else if (line[i] == '"')
            quoted = !quoted;
        else if (line[i] == ',' && !quoted)
            fields.emplace_back();
        else
            fields.back() += line[i];
    }
    return fields;
}

TEST(Csv, ReadsBackWhatWasMeasured) {
    std::istringstream in(csv_of(little_result(), {"a processor", "a compiler", "", "1.0"}));
    std::string line;
    std::vector<std::vector<std::string>> rows;
    int comments = 0;
    bool says_commit = false;
    while (std::getline(in, line)) {
        if (line[0] == '#') {
            comments++;
            says_commit |= line.find("commit unknown") != std::string::npos;
        } else {
            rows.push_back(fields_of(line));
        }
    }
    EXPECT_GE(comments, 5);
    EXPECT_TRUE(says_commit);
    ASSERT_EQ(rows.size(), 4u);
    const auto column = [&](const char* name) {
        return size_t(std::find(rows[0].begin(), rows[0].end(), name) - rows[0].begin());
    };
    ASSERT_LT(column("failure"), rows[0].size());
    EXPECT_EQ(rows[1][column("series")], "bdf2");
    EXPECT_EQ(rows[1][column("error")], "0.0125");
    EXPECT_EQ(rows[1][column("cpu_s_per_s")], "0.004");
    EXPECT_EQ(rows[1][column("on_front")], "1");
    EXPECT_EQ(rows[1][column("failure") + 1], "rms, of all");
    EXPECT_EQ(rows[2][column("error")], "");
    EXPECT_EQ(rows[2][column("failure")], "unstable, \"as known\"");
    EXPECT_EQ(rows[3][column("series")], "one at a time");
}

TEST(Markdown, HasTablesOfEvenRowsAndMarksTheFront) {
    const std::string text = markdown_of(little_result());
    EXPECT_NE(text.find("**bdf2: 1/60 s"), std::string::npos) << text;
    EXPECT_NE(text.find("| baseline | 0.0125 | 4 |"), std::string::npos) << text;
    EXPECT_NE(text.find("a\\|b"), std::string::npos);
    std::istringstream in(text);
    std::string line;
    while (std::getline(in, line)) {
        if (line.empty() || line[0] != '|') continue;
        int bars = 0;
        for (size_t i = 0; i < line.size(); i++) bars += line[i] == '|' && (i == 0 || line[i - 1] != '\\');
        EXPECT_EQ(bars, 6) << line;
    }
}

TEST(Plot, QuotesTextAndDrawsBothKinds) {
    EXPECT_EQ(gnuplot_text("a \"b\" \\c"), "\"a \\\"b\\\" \\\\c\"");
    const std::string folder = ::testing::TempDir() + "frond plot's";
    prepare_folder(folder);
    const std::string base = folder + "/swing";
    write_file(base + ".gp", gnuplot_of(little_result(), base));
    require_gnuplot();
    run_gnuplot(base + ".gp");
    for (const char* extension : {".svg", ".png"}) EXPECT_GT(std::filesystem::file_size(base + extension), 1000u);
    std::filesystem::remove_all(folder);
}

TEST(Plot, OfNothingSaysSo) {
    Result result = little_result();
    result.points = {result.points[1]};
    EXPECT_NE(gnuplot_of(result, "x").find("nothing could be measured"), std::string::npos);
}

TEST(Summary, LeadsToEveryProblem) {
    const std::string text =
        summary_of({little_result()}, {}, {"a processor", "a compiler", "abc", "1.0"}, "frond study");
    for (const char* wanted : {"(swing.svg)", "a processor", "abc", "[swing](#swing)"})
        EXPECT_NE(text.find(wanted), std::string::npos) << wanted;
}

TEST(Files, ThatCannotBeWrittenAreNamed) {
    const std::string file = ::testing::TempDir() + "frond_not_a_folder";
    write_file(file, "x");
    for (const std::string& folder : {file, file + "/below"}) {
        try {
            prepare_folder(folder);
            FAIL() << folder;
        } catch (const SceneError& error) {
            EXPECT_NE(std::string(error.what()).find(folder), std::string::npos);
            EXPECT_NE(std::string(error.what()).find("--out"), std::string::npos);
        }
    }
    std::filesystem::remove(file);
}

TEST(Problems, ThatDoNotExistGiveTheNamesThereAre) {
    try {
        find_problem("no_such");
        FAIL();
    } catch (const SceneError& error) {
        for (const Problem& problem : problems())
            EXPECT_NE(std::string(error.what()).find(problem.name), std::string::npos);
    }
}

}  // namespace report_tests
