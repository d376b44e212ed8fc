// Checks URDF text before urdfdom, which overflows its stack on deeply nested files, takes cycles for trees and drops
// what it cannot read. In: XML. Out: the same elements with capsules as cylinders, and notes on what urdfdom drops.
#include <tinyxml2.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <set>

#include "importer/urdf.hpp"
#include "section/section.hpp"

namespace frond {

using tinyxml2::XMLElement;

static constexpr size_t LARGEST_TEXT = size_t(64) << 20;  // [byte]

static std::string attribute(const XMLElement& element, const char* name) {
    const char* value = element.Attribute(name);
    return value ? value : "";
}

static void refuse_xacro(const XMLElement& root) {
    for (const tinyxml2::XMLAttribute* a = root.FirstAttribute(); a; a = a->Next())
        if (!strcmp(a->Name(), "xmlns:xacro"))
            for (const XMLElement* e = root.FirstChildElement(); e; e = e->NextSiblingElement())
                if (!strncmp(e->Name(), "xacro:", 6))
                    fail(FROND_RESULT_FILE_FORMAT, "line %d: <%s> is xacro, not URDF; run xacro on the file first",
                         e->GetLineNum(), e->Name());
}

// Turns the capsules of a link's visuals or collisions into cylinders. Returns for each shape whether it was a capsule.
static std::vector<bool> take_capsules(XMLElement& link, const char* name, size_t& shapes) {
    std::vector<bool> capsules;
    for (XMLElement* e = link.FirstChildElement(name); e; e = e->NextSiblingElement(name)) {
        if (++shapes > MOST_SHAPES) fail(FROND_RESULT_FILE_FORMAT, "the file has more than %u shapes", MOST_SHAPES);
        XMLElement* geometry = e->FirstChildElement("geometry");
        XMLElement* capsule = geometry ? geometry->FirstChildElement("capsule") : nullptr;
        if (capsule) capsule->SetName("cylinder");
        capsules.push_back(capsule != nullptr);
    }
    return capsules;
}

// Reads the numbers of an attribute; they stay zero if it is missing.
static void take_numbers(const XMLElement& element, const char* name, const std::vector<double*>& out) {
    const char* at = element.Attribute(name);
    if (!at) return;
    for (double* value : out) {
        char* end = nullptr;
        *value = strtod(at, &end);
        if (end == at || !(*value > 0 && *value < 1e15))
            fail(FROND_RESULT_FILE_FORMAT, "line %d: %s=\"%.64s\" is to be %zu numbers above zero",
                 element.GetLineNum(), name, element.Attribute(name), out.size());
        at = end;
    }
}

static void take_frond(const XMLElement& element, UrdfLink& link) {
    link.organ = attribute(element, "organ");
    link.organ_name = attribute(element, "name");
    link.organ_material = attribute(element, "material");
    take_numbers(element, "mass", {&link.section_mass});
    take_numbers(element, "stretching", {&link.stretching});
    take_numbers(element, "bending", {&link.bending_x, &link.bending_y});
    take_numbers(element, "twisting", {&link.twisting});
    if (element.Attribute("taper") && (element.QueryDoubleAttribute("taper", &link.taper) != tinyxml2::XML_SUCCESS ||
                                       !(std::abs(link.taper) <= LARGEST_TAPER)))
        fail(FROND_RESULT_FILE_FORMAT, "line %d: taper=\"%.64s\" is to be a number from %g to %g", element.GetLineNum(),
             element.Attribute("taper"), -LARGEST_TAPER, LARGEST_TAPER);
    const double numbers[] = {link.section_mass, link.stretching, link.bending_x, link.twisting};
    const auto given = std::count_if(std::begin(numbers), std::end(numbers), [](double value) { return value > 0; });
    if (given != 0 && given != 4)
        fail(FROND_RESULT_FILE_FORMAT, "line %d: a section has mass, stretching, bending and twisting, or none of them",
             element.GetLineNum());
}

static void take_link(XMLElement& link, UrdfText& text, size_t& shapes) {
    const std::string name = attribute(link, "name");
    const int line = link.GetLineNum();
    if (name.empty()) fail(FROND_RESULT_FILE_FORMAT, "line %d: a link has no name", line);
    UrdfNotes notes;
    notes.line = line;
    notes.visual_capsules = take_capsules(link, "visual", shapes);
    notes.collision_capsules = take_capsules(link, "collision", shapes);
    notes.has_inertial = link.FirstChildElement("inertial") != nullptr;
    if (const XMLElement* frond = link.FirstChildElement("frond")) take_frond(*frond, notes.of_frond);
    if (!text.links.emplace(name, notes).second)
        fail(FROND_RESULT_FILE_FORMAT, "line %d: there are two links \"%.64s\"; give each its own name", line,
             name.c_str());
    if (text.links.size() > MOST_LINKS) fail(FROND_RESULT_FILE_FORMAT, "the file has more than %u links", MOST_LINKS);
}

static std::string end_of(const XMLElement& joint, const char* end) {
    const XMLElement* element = joint.FirstChildElement(end);
    return element ? attribute(*element, "link") : "";
}

static void check_type(const XMLElement& joint) {
    static const std::set<std::string> TYPES = {"fixed", "revolute", "continuous", "prismatic", "floating"};
    const std::string type = attribute(joint, "type");
    if (!TYPES.count(type))
        fail(FROND_RESULT_FILE_FORMAT,
             "line %d: joint \"%.64s\" is of type \"%.32s\"; there are fixed, revolute, continuous, prismatic and "
             "floating "
             "ones, of which others can be put together",
             joint.GetLineNum(), attribute(joint, "name").c_str(), type.c_str());
}

// Checks that every link but one has one parent, and that all links are connected to that one.
static void check_tree(const XMLElement& root, const UrdfText& text) {
    std::map<std::string, std::vector<std::string>> children;
    std::set<std::string> has_parent;
    for (const XMLElement* joint = root.FirstChildElement("joint"); joint; joint = joint->NextSiblingElement("joint")) {
        check_type(*joint);
        const std::string name = attribute(*joint, "name"), parent = end_of(*joint, "parent"),
                          child = end_of(*joint, "child");
        for (const std::string& end : {parent, child})
            if (!text.links.count(end))
                fail(FROND_RESULT_FILE_FORMAT,
                     "line %d: joint \"%.64s\" names the link \"%.64s\", which the file does not have",
                     joint->GetLineNum(), name.c_str(), end.c_str());
        if (!has_parent.insert(child).second)
            fail(FROND_RESULT_FILE_FORMAT,
                 "line %d: joint \"%.64s\" gives link \"%.64s\" a second parent; links have one", joint->GetLineNum(),
                 name.c_str(), child.c_str());
        children[parent].push_back(child);
    }
    std::vector<std::string> open;
    for (const auto& [name, notes] : text.links)
        if (!has_parent.count(name)) open.push_back(name);
    if (open.empty())
        fail(FROND_RESULT_FILE_FORMAT, "its joints go round in a cycle: every link has a parent; leave one out");
    if (open.size() > 1)
        fail(FROND_RESULT_FILE_FORMAT, "links \"%.64s\" and \"%.64s\" both have no parent; join all links to one root",
             open[0].c_str(), open[1].c_str());
    size_t reached = 0;
    while (!open.empty()) {
        const std::string name = open.back();
        open.pop_back();
        ++reached;
        for (const std::string& child : children[name]) open.push_back(child);
    }
    if (reached != text.links.size())
        fail(FROND_RESULT_FILE_FORMAT,
             "%zu of its %zu links hang on a cycle of joints, not on the root; leave one joint out",
             text.links.size() - reached, text.links.size());
}

UrdfText check_urdf(const MeshFile& file) {
    if (file.bytes.size() > LARGEST_TEXT) fail(FROND_RESULT_FILE_FORMAT, "the file is larger than 64 MiB");
    tinyxml2::XMLDocument document;
    if (document.Parse(file.bytes.data(), file.bytes.size()) != tinyxml2::XML_SUCCESS)
        fail(FROND_RESULT_FILE_FORMAT, "line %d: the XML is damaged or nested too deeply: %s", document.ErrorLineNum(),
             document.ErrorName());
    XMLElement* root = document.FirstChildElement("robot");
    if (!root) {
        const XMLElement* other = document.RootElement();
        fail(FROND_RESULT_FILE_FORMAT, "its root is <%.32s>, not <robot>: no URDF", other ? other->Name() : "nothing");
    }
    refuse_xacro(*root);
    UrdfText text;
    size_t shapes = 0;
    for (XMLElement* link = root->FirstChildElement("link"); link; link = link->NextSiblingElement("link"))
        take_link(*link, text, shapes);
    if (text.links.empty()) fail(FROND_RESULT_FILE_FORMAT, "the file has no links");
    check_tree(*root, text);
    tinyxml2::XMLPrinter printer(nullptr, true);
    root->Accept(&printer);
    text.xml = printer.CStr();
    return text;
}

}  // namespace frond
