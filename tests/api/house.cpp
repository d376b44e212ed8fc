// House rules: each public function has a sentence of its own, and names in headers and glossary agree.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace house_tests {

const std::string PLUGIN = std::string(FROND_SOURCE_DIR) + "/plugin/";

std::string read(const std::string& path) {
    std::ifstream file(path);
    EXPECT_TRUE(file) << path;
    return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

// Returns the C headers, one after the other.
std::string headers() {
    std::string text;
    for (const auto& entry : std::filesystem::directory_iterator(PLUGIN + "include/frond"))
        if (entry.path().extension() == ".h") text += read(entry.path().string());
    return text;
}

std::set<std::string> matches(const std::string& text, const std::regex& pattern, size_t group = 0) {
    std::set<std::string> found;
    for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
        found.insert((*match)[group]);
    return found;
}

std::string without_comments(const std::string& text) {
    std::string code;
    for (size_t i = 0; i < text.size();) {
        const size_t begin = text.find("/*", i);
        code += text.substr(i, begin - i) + " ";
        if (begin == std::string::npos) break;
        i = text.find("*/", begin) + 2;
    }
    return code;
}

// Returns the comment that ends in the line before this one, in C or C++ style; empty: there is none.
std::string comment_before(const std::vector<std::string>& lines, size_t line) {
    size_t first = line;
    while (first > 0 && lines[first - 1].rfind("//", 0) == 0) first--;
    if (first == line) {
        if (line == 0 || lines[line - 1].find("*/") == std::string::npos) return "";
        first = line - 1;
        while (first > 0 && lines[first].find("/*") == std::string::npos) first--;
    }
    std::string text;
    for (size_t i = first; i < line; i++) text += lines[i] + " ";
    return text;
}

std::set<std::string> words_of(const std::string& text) {
    return matches(text, std::regex("[a-z]+"));
}

// Returns one cell of each row of the glossary's tables of terms.
std::vector<std::string> glossary_column(size_t column) {
    std::vector<std::string> cells;
    for (const std::string& line : lines_of(read(PLUGIN + "GLOSSARY.md"))) {
        if (line.rfind("| ", 0) != 0 || line.rfind("| term", 0) == 0) continue;
        std::istringstream stream(line);
        std::string cell;
        for (size_t i = 0; i <= column + 1; i++) std::getline(stream, cell, '|');
        cells.push_back(cell);
    }
    return cells;
}

TEST(House, EachPublicFunctionHasASentence) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(PLUGIN + "include/frond")) {
        const std::vector<std::string> lines = lines_of(read(entry.path().string()));
        for (size_t i = 0; i < lines.size(); i++) {
            std::smatch name;
            static const std::regex DECLARATION("^(?:FROND_API|static inline) .*?(\\w+)\\(");
            if (!std::regex_search(lines[i], name, DECLARATION)) continue;
            count++;
            // A macro may stand between comment and declaration.
            size_t at = i;
            while (at > 0 && lines[at - 1].rfind("#define", 0) == 0) at--;
            static const std::regex SENTENCE("^/[/*] [A-Z][a-z]+s [^]*\\.");
            EXPECT_TRUE(std::regex_search(comment_before(lines, at), SENTENCE))
                << entry.path().filename() << ":" << i + 1 << ": say in a sentence what " << name[1]
                << " does: \"Returns ...\"";
        }
    }
    EXPECT_GT(count, 100);
}

TEST(House, EnumValuesBeginWithTheirEnumsName) {
    const std::string code = without_comments(headers());
    const std::regex ENUM("typedef enum frond_(\\w+) \\{([^}]*)\\}");
    int count = 0;
    for (std::sregex_iterator match(code.begin(), code.end(), ENUM), end; match != end; ++match, ++count) {
        std::string prefix = "FROND_" + std::string((*match)[1]) + "_";
        std::transform(prefix.begin(), prefix.end(), prefix.begin(), [](char c) { return char(std::toupper(c)); });
        const std::string body = (*match)[2];
        for (const std::string& value : matches(body, std::regex("\\bFROND_\\w+\\b(?!\\()"))) {
            if (value == "FROND_OK") continue;
            EXPECT_EQ(value.rfind(prefix, 0), 0u) << value << " of " << prefix;
        }
        // Rows of a table get the prefix from the macro that lists them.
        const std::set<std::string> macros = matches(body, std::regex("\\((FROND_\\w+_ENUM)\\)"), 1);
        for (const std::string& macro : macros)
            EXPECT_NE(code.find("#define " + macro + "(code, text) " + prefix + "##code"), std::string::npos) << macro;
    }
    EXPECT_GT(count, 12);
}

TEST(House, NamesAreWordsOfTheGlossary) {
    const std::string text = read(PLUGIN + "GLOSSARY.md"), code = without_comments(headers());
    // Each type is in the glossary's list, and each name in the list exists.
    const std::set<std::string> types = matches(code, std::regex("(?:\\} |typedef uint32_t )(frond_\\w+);"), 1);
    const std::set<std::string> listed = matches(text, std::regex("`(frond_\\w+)`"), 1);
    EXPECT_GT(types.size(), 40u);
    for (const std::string& type : types) EXPECT_EQ(listed.count(type), 1u) << "list " << type << " in GLOSSARY.md";
    const std::set<std::string> names = matches(code, std::regex("\\bfrond_\\w+"));
    for (const std::string& name : listed) EXPECT_EQ(names.count(name), 1u) << name << " of GLOSSARY.md is no name";
    // No name contains a word that the glossary replaced, unless it is also a term.
    std::set<std::string> terms, replaced;
    for (const std::string& cell : glossary_column(0))
        for (const std::string& word : words_of(cell)) terms.insert(word);
    for (const std::string& cell : glossary_column(3))
        for (const std::string& word : words_of(cell)) replaced.insert(word);
    EXPECT_GT(replaced.size(), 15u);
    for (const std::string& name : matches(code, std::regex("\\b[A-Za-z_]\\w*\\b"))) {
        std::string lower = name;
        std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) { return char(std::tolower(c)); });
        for (const std::string& word : words_of(lower))
            EXPECT_FALSE(replaced.count(word) && !terms.count(word)) << name << ": the glossary has another word";
    }
}

TEST(House, ReleaseNotesNameWhatThereIs) {
    const std::string code = headers();
    int count = 0;
    for (const std::string& line : lines_of(read(PLUGIN + "RELEASE_NOTES.md"))) {
        std::smatch row;
        if (!std::regex_match(line, row, std::regex("\\| `(\\w+)` \\| `(\\w+)` \\|"))) continue;
        count++;
        const std::regex old_name("\\b" + std::string(row[1]) + "\\b"), new_name("\\b" + std::string(row[2]) + "\\b");
        std::string whole = code;
        EXPECT_FALSE(std::regex_search(without_comments(whole), old_name)) << row[1];
    }
    EXPECT_GT(count, 60);
}

}  // namespace house_tests
