// Programs made at random: they are data, shrink, become C that does the same, and those that once broke a law keep it.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "programs/search.hpp"
#include "programs/shrink.hpp"
#include "programs/source.hpp"
#include "scenes/scene.hpp"

using namespace frond::programs;

namespace {

std::string read(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

const std::filesystem::path FOLDER = FROND_SOURCE_DIR "/tests/programs";

Program every_operation() {
    return program_from(read(FOLDER / "every_operation.txt"));
}

TEST(Programs, AreTheSameForTheSameSeed) {
    std::set<std::string> texts;
    for (uint64_t seed = 1; seed <= 200; seed++) {
        const std::string text = text_of(random_program(seed));
        EXPECT_EQ(text, text_of(random_program(seed)));
        EXPECT_EQ(text, text_of(program_from(text)));
        texts.insert(text);
    }
    EXPECT_EQ(texts.size(), 200);
}

TEST(Programs, UseEveryOperationAndEveryValueInRange) {
    std::set<size_t> used;
    for (uint64_t seed = 1; seed <= 500; seed++)
        for (const Operation& operation : random_program(seed).operations) {
            used.insert(operation.verb);
            const Verb& verb = verb_of(operation);
            ASSERT_EQ(operation.numbers.size(), verb.parameters.size());
            for (size_t i = 0; i < operation.numbers.size(); i++) {
                const Parameter& p = verb.parameters[i];
                EXPECT_GE(operation.numbers[i], std::min(p.low, p.usual)) << verb.name << " " << p.name;
                EXPECT_LE(operation.numbers[i], std::max(p.high, p.usual)) << verb.name << " " << p.name;
            }
        }
    EXPECT_EQ(used.size(), verbs().size());
    for (const Operation& operation : every_operation().operations) used.erase(operation.verb);
    EXPECT_TRUE(used.empty()) << "every_operation.txt lacks " << verbs()[*used.begin()].name;
}

TEST(Programs, TextThatIsWrongIsRefusedByItsLine) {
    const auto refusal = [](const char* text) -> std::string {
        try {
            program_from(text);
        } catch (const frond::tools::SceneError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(refusal("world\nfly 1\n"), "line 2: there is no operation \"fly\"");
    EXPECT_EQ(refusal("world\nplant 1\n"), "line 2: it needs the number of a model");
    EXPECT_EQ(refusal("world colour=3\n"), "line 1: the operation world has no colour");
    EXPECT_EQ(refusal("world gx=far\n"), "line 1: \"gx=far\" has no number");
    EXPECT_EQ(refusal("world\nstep 7\n"), "line 2: \"7\" is no name=number");
    EXPECT_EQ(refusal("stems 1\n"), "a program begins with the operation world");
}

TEST(Programs, ShrinkToWhatBreaksTheLaw) {
    // A law that a kick after wind breaks, if it is faster than 1 m/s.
    const auto breaks = [](const Program& program) {
        bool blown = false;
        for (const Operation& operation : program.operations) {
            const std::string name = verb_of(operation).name;
            blown |= name == "wind";
            if (blown && name == "kick" && number(operation, "z") > 1) return true;
        }
        return false;
    };
    int tried = 0;
    for (uint64_t seed = 1; seed <= 3000 && tried < 5; seed++) {
        const Program program = random_program(seed);
        if (!breaks(program)) continue;
        tried++;
        const Program shrunk = shrink(program, breaks, [] { return false; });
        std::vector<std::string> names;
        for (const Operation& operation : shrunk.operations) names.push_back(verb_of(operation).name);
        ASSERT_EQ(names.size(), 5) << text_of(shrunk);
        EXPECT_EQ(names[0], "world");
        EXPECT_EQ(names[2], "plant");
        EXPECT_EQ(names[4], "kick");
        EXPECT_EQ(number(shrunk.operations[4], "x"), 2) << "as usual";
        EXPECT_TRUE(breaks(shrunk));
    }
    EXPECT_EQ(tried, 5);
}

// Compiles a program's source and returns what its last line says of the state.
std::string hash_of_source(const Program& program) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path();
    const bool is_cpp = needs_cpp(program);
    const std::string name = folder / ("frond_program_" + std::to_string(getpid()));
    const std::string file = name + (is_cpp ? ".cpp" : ".c");
    std::ofstream(file) << c_source(program, "A test");
    const std::string compile = std::string(is_cpp ? CXX_COMPILER " -std=c++17 -w " BULLET_FLAGS
                                                   : C_COMPILER " -std=c99 -Wall -Wextra -Werror") +
                                " -I" FROND_SOURCE_DIR "/plugin/include -DMODELS='\"" FROND_SOURCE_DIR "/models\"' " +
                                file + " -o " + name + " " FROND_LIBRARY " -Wl,-rpath," FROND_LIBRARY_FOLDER +
                                (is_cpp ? " " BULLET_LIBRARIES : "");
    std::string last;
    if (std::system(compile.c_str()) == 0) {
        FILE* out = popen((name + " 2>/dev/null").c_str(), "r");
        char line[400];
        while (out && std::fgets(line, sizeof line, out)) last = line;
        if (out) pclose(out);
    }
    for (const std::string& path : {name, file}) std::filesystem::remove(path);
    return last;
}

std::string hash_of_run(const Program& program) {
    const Outcome outcome = outcome_apart(program, 100, bit_of(Law::CALL));
    EXPECT_NE(outcome.law, Law::CRASH) << outcome.text;
    char text[40];
    std::snprintf(text, sizeof text, "hash %016llx\n", static_cast<unsigned long long>(outcome.hash));
    return text;
}

TEST(Programs, BecomeCThatDoesTheSame) {
    EXPECT_EQ(hash_of_source(every_operation()), hash_of_run(every_operation()));
}

class ProgramsInHost : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Kinds, ProgramsInHost, testing::Range(0, 6));
TEST_P(ProgramsInHost, BecomeCppThatDoesTheSame) {
    const Program program = program_from("world host=" + std::to_string(GetParam()) +
                                         "\nstems 1\nplant 2 1 mechanics=3\nground 3\nbody 4 mass=0.1 x=0.2 vx=-2\n"
                                         "step count=20\npush 2 count=5\nstep count=5\n");
    EXPECT_EQ(hash_of_source(program), hash_of_run(program));
}

// What once broke a law, and does no more.
TEST(Programs, OfTheCorpusKeepAllLaws) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(FOLDER / "corpus")) {
        const Outcome outcome = outcome_apart(program_from(read(entry.path())), 100);
        EXPECT_TRUE(outcome.is_kept) << entry.path() << ": " << name_of(outcome.law) << ": " << outcome.text;
        count++;
    }
    EXPECT_GT(count, 0);
}

}  // namespace
