// In: a model, or its bytes. Out: the other. Layout: magic word, Frond's version, layout, hash of the fields' types,
// length and checksum of what follows; then the fields in the order of cook_fields.cpp. All is little-endian.
#include "modelling/cook.hpp"

#include <cstring>

#include "core/error.hpp"
#include "core/platform/files.hpp"
#include "core/timer.hpp"
#include "modelling/attach.hpp"

namespace frond {
namespace {

constexpr std::array<char, 8> COOKED = {'F', 'R', 'O', 'N', 'D', 'M', 'D', 'L'};
// To be raised when a field's meaning changes; a change of the fields' types is told by their hash.
constexpr uint32_t COOKED_LAYOUT = 1;
constexpr size_t COOKED_HEAD = 56;
constexpr uint64_t LARGEST_COOKED = uint64_t(1) << 32;  // [byte]
constexpr Archive::Words COOKED_WORDS = {"the cooked model", "cook it anew"};

struct CookedHead {
    std::array<char, 8> magic = COOKED;
    std::array<char, 16> version = {};  // Frond's, for texts
    uint32_t layout = COOKED_LAYOUT, zero = 0;
    uint64_t types = 0, length = 0, checksum = 0;
};

void visit(Archive& a, CookedHead& head) {
    auto& [magic, version, layout, zero, types, length, checksum] = head;
    a(magic, version, layout, zero, types, length, checksum);
}

uint64_t hash_of_types() {
    static const uint64_t hash = [] {
        Archive archive = Archive::of_types();
        Model model;
        visit(archive, model);
        return checksum_of(archive.out.data(), archive.out.size());
    }();
    return hash;
}

CookedHead read_head(const uint8_t* bytes, size_t count) {
    if (count < COOKED.size() || std::memcmp(bytes, COOKED.data(), COOKED.size()) != 0)
        fail(FROND_RESULT_FILE_FORMAT, "this is not a cooked model; pass what frond_model_save or frond cook wrote");
    if (count < COOKED_HEAD)
        fail(FROND_RESULT_FILE_FORMAT, "the cooked model has %zu bytes, fewer than its header; pass all of it", count);
    CookedHead head;
    Archive archive(bytes, COOKED_HEAD, COOKED_WORDS);
    archive(head);
    head.version.back() = 0;
    for (char& letter : head.version)
        if (letter != 0 && (letter < ' ' || letter > '~')) letter = '?';
    return head;
}

void check_head(const CookedHead& head, const uint8_t* fields, size_t count) {
    if (head.layout != COOKED_LAYOUT || head.types != hash_of_types())
        fail(FROND_RESULT_FILE_FORMAT,
             "the model was cooked by Frond %s, which keeps models in another way than " FROND_VERSION_STRING
             "; cook it anew with this one",
             head.version.data());
    if (head.length != count)
        fail(FROND_RESULT_FILE_FORMAT, "the cooked model declares %llu bytes and has %zu; pass all of it and no more",
             static_cast<unsigned long long>(head.length), count);
    if (head.checksum != checksum_by_words(fields, count)) fail_cooked("its checksum differs");
}

}  // namespace

void fail_cooked(const std::string& what) {
    fail(FROND_RESULT_FILE_FORMAT, "the cooked model is damaged: %s; cook it anew", what.c_str());
}

std::vector<uint8_t> cook(const Model& model) {
    Archive fields, all;
    {
        const std::lock_guard<std::mutex> lock(model.rest_shapes->mutex);
        // An archive that writes changes nothing.
        fields(const_cast<Model&>(model));
    }
    CookedHead head;
    std::strncpy(head.version.data(), FROND_VERSION_STRING, head.version.size() - 1);
    head.types = hash_of_types();
    head.length = fields.out.size();
    head.checksum = checksum_by_words(fields.out.data(), fields.out.size());
    all(head);
    all.out.insert(all.out.end(), fields.out.begin(), fields.out.end());
    return std::move(all.out);
}

static std::shared_ptr<const Model> read_cooked(const uint8_t* bytes, size_t count, const Timer& timer) {
    const CookedHead head = read_head(bytes, count);
    bytes += COOKED_HEAD;
    count -= COOKED_HEAD;
    check_head(head, bytes, count);
    auto model = std::make_shared<Model>();
    Archive archive(bytes, count, COOKED_WORDS);
    archive(*model);
    if (!archive.is_at_end()) fail_cooked("it is longer than what it holds");
    const std::string fault = find_fault(*model);
    if (!fault.empty()) fail_cooked(fault);
    list_chain(*model);
    model->ms_import = model->ms_total = timer.ms();
    return model;
}

std::shared_ptr<const Model> model_from_cooked(const uint8_t* bytes, size_t count) {
    return read_cooked(bytes, count, Timer());
}

bool is_cooked(const std::string& path) {
    std::string bytes, error;
    return is_regular_file(path) && read_file(path, COOKED.size(), bytes, error) && bytes.size() == COOKED.size() &&
           std::memcmp(bytes.data(), COOKED.data(), COOKED.size()) == 0;
}

std::shared_ptr<const Model> load_cooked(const std::string& path) {
    const Timer timer;
    std::string bytes, error;
    if (!read_file(path, LARGEST_COOKED, bytes, error))
        fail(FROND_RESULT_FILE_NOT_FOUND, "%s cannot be read: %s", path.c_str(), error.c_str());
    try {
        return read_cooked(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size(), timer);
    } catch (const Error& failure) {
        fail(failure.code, "%s: %s", file_name(path).c_str(), failure.what());
    }
}

}  // namespace frond
