// Members that the import reads and that a reader would replace by their defaults in silence: each kind is refused by
// the JSON pointer.
#include "catch.h"
#include "error.h"
#include "gltf/import.h"
#include "gltf_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

struct Row {
    const char* members;  // of the root object
    const char* pointer;
    const char* reason;
};

constexpr Row rows[] = {
    // Optional members of a wrong type.
    {R"("materials":[{"pbrMetallicRoughness":{"roughnessFactor":"0.1"}}])",
     "/materials/0/pbrMetallicRoughness/roughnessFactor", "is no number: \"0.1\""},
    {R"("materials":[{"pbrMetallicRoughness":{"metallicFactor":null}}])",
     "/materials/0/pbrMetallicRoughness/metallicFactor", "is no number: null"},
    {R"("materials":[{},{"pbrMetallicRoughness":[]}])", "/materials/1/pbrMetallicRoughness", "is no object"},
    {R"("materials":[{"doubleSided":1}])", "/materials/0/doubleSided", "is neither true nor false"},
    {R"("materials":[{"alphaMode":3}])", "/materials/0/alphaMode", "is no string"},
    {R"("materials":[{"alphaCutoff":{}}])", "/materials/0/alphaCutoff", "is no number"},
    {R"("materials":[{"name":7}])", "/materials/0/name", "is no string"},
    {R"("materials":[{"extensions":[]}])", "/materials/0/extensions", "is no object"},
    {R"("materials":[{"extensions":{"KHR_materials_ior":{"ior":[1.5]}}}])",
     "/materials/0/extensions/KHR_materials_ior/ior", "is no number"},
    {R"("materials":[{"extensions":{"KHR_materials_specular":{"specularFactor":"1"}}}])",
     "/materials/0/extensions/KHR_materials_specular/specularFactor", "is no number"},
    {R"("materials":[{"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":true}}}])",
     "/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength", "is no number"},
    {R"("materials":[{"extensions":{"KHR_materials_unlit":true}}])", "/materials/0/extensions/KHR_materials_unlit",
     "is no object"},
    {R"("materials":[{"emissiveTexture":{"index":0,"extensions":{"KHR_texture_transform":{"rotation":"90"}}}}])",
     "/materials/0/emissiveTexture/extensions/KHR_texture_transform/rotation", "is no number"},
    {R"("textures":[{"source":"0"}])", "/textures/0/source", "is no index"},
    {R"("samplers":[{"wrapS":"REPEAT"}])", "/samplers/0/wrapS", "is no integer"},
    {R"("images":[{"uri":5}])", "/images/0/uri", "is no string"},
    {R"("nodes":[{"matrix":"x"}])", "/nodes/0/matrix", "is no array"},
    {R"("nodes":[{"translation":["1",0,0]}])", "/nodes/0/translation/0", "is no number"},
    {R"("nodes":[{"rotation":[null,0,0,1]}])", "/nodes/0/rotation/0", "is no number: null"},
    {R"("nodes":[{"weights":["a"]}])", "/nodes/0/weights/0", "is no number"},
    {R"("nodes":[{"children":7}])", "/nodes/0/children", "is no array"},
    {R"("nodes":{"0":{}})", "/nodes", "is no array"},
    {R"("scenes":[{"nodes":[true]}])", "/scenes/0/nodes/0", "is no index"},
    {R"("accessors":[{"componentType":5126,"count":1,"type":"VEC3","normalized":"yes"}])", "/accessors/0/normalized",
     "is neither true nor false"},
    {R"("accessors":[{"componentType":5126,"count":1,"type":"VEC3","sparse":[]}])", "/accessors/0/sparse",
     "is no object"},
    {R"("accessors":[{"componentType":5126,"count":1,"type":"VEC5"}])", "/accessors/0/type", "is no type of element"},
    {R"("cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":1,"aspectRatio":"1"}}])",
     "/cameras/0/perspective/aspectRatio", "is no number"},
    {R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":"x"}]}})",
     "/extensions/KHR_lights_punctual/lights/0/intensity", "is no number"},
    {R"("animations":{"0":{}})", "/animations", "is no array"},
    {R"("animations":[{"samplers":[{"input":"0"}]}])", "/animations/0/samplers/0/input", "is no index"},
    {R"("extensionsUsed":"KHR_materials_ior")", "/extensionsUsed", "is no array"},
    {R"("extensionsRequired":[5])", "/extensionsRequired/0", "is no string"},
    // Indices and sizes that are negative, broken or beyond 32 bits.
    {R"("materials":[{"normalTexture":{"index":-1}}])", "/materials/0/normalTexture/index", "is no index: -1"},
    {R"("materials":[{"normalTexture":{"index":0,"texCoord":-1}}])", "/materials/0/normalTexture/texCoord",
     "is no index: -1"},
    {R"("nodes":[{"mesh":4294967296}])", "/nodes/0/mesh", "is no index: 4294967296"},
    {R"("nodes":[{"mesh":0.5}])", "/nodes/0/mesh", "is no index: 0.5"},
    {R"("scene":-1)", "/scene", "is no index"},
    {R"("meshes":[{"primitives":[{"attributes":{"POSITION":4294967296}}]}])",
     "/meshes/0/primitives/0/attributes/POSITION", "is no index"},
    {R"("meshes":[{"primitives":[{"attributes":{"A/B~C":-1}}]}])", "/meshes/0/primitives/0/attributes/A~1B~0C",
     "is no index"},
    {R"("meshes":[{"primitives":[{"attributes":{},"mode":4.5}]}])", "/meshes/0/primitives/0/mode", "is no integer"},
    {R"("bufferViews":[{"buffer":0,"byteLength":4,"byteStride":-4}])", "/bufferViews/0/byteStride",
     "is no whole number from 0 up"},
    {R"("bufferViews":[{"buffer":0,"byteLength":4,"byteOffset":0.5}])", "/bufferViews/0/byteOffset",
     "is no whole number from 0 up"},
    {R"("accessors":[{"componentType":5126,"count":1,"type":"VEC3","byteOffset":-12}])", "/accessors/0/byteOffset",
     "is no whole number from 0 up"},
    {R"("animations":[{"channels":[{"sampler":-1}]}])", "/animations/0/channels/0/sampler", "is no index"},
    // Numbers beyond single precision, and beyond double.
    {R"("nodes":[{"translation":[1e300,0,0]}])", "/nodes/0/translation/0", "is out of range: 1e+300"},
    {R"("nodes":[{},{"scale":[1,-1e39,1]}])", "/nodes/1/scale/1", "is out of range"},
    {R"("nodes":[{"scale":[1,1,1e999]}])", "/nodes/0/scale/2", "is out of range: 1e999"},
    {R"("materials":[{"extensions":{"KHR_materials_ior":{"ior":1e40}}}])",
     "/materials/0/extensions/KHR_materials_ior/ior", "is out of range"},
    // Arrays of another length, members that are not there, and members that are there twice.
    {R"("materials":[{"emissiveFactor":[1,1]}])", "/materials/0/emissiveFactor", "has 2 elements instead of 3"},
    {R"("materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,1,1]}}])",
     "/materials/0/pbrMetallicRoughness/baseColorFactor", "has 3 elements instead of 4"},
    {R"("materials":[{"extensions":{"KHR_materials_specular":{"specularColorFactor":[1]}}}])",
     "/materials/0/extensions/KHR_materials_specular/specularColorFactor", "has 1 elements instead of 3"},
    {R"("materials":[{"emissiveTexture":{"index":0,"extensions":{"KHR_texture_transform":{"scale":[2]}}}}])",
     "/materials/0/emissiveTexture/extensions/KHR_texture_transform/scale", "has 1 elements instead of 2"},
    {R"("materials":[{"normalTexture":{"scale":1}}])", "/materials/0/normalTexture", "lacks 'index'"},
    {R"("accessors":[{"componentType":5126,"type":"VEC3"}])", "/accessors/0", "lacks 'count'"},
    {R"("bufferViews":[{"buffer":0}])", "/bufferViews/0", "lacks 'byteLength'"},
    {R"("meshes":[{"primitives":[{}]}])", "/meshes/0/primitives/0", "lacks 'attributes'"},
    {R"("skins":[{}])", "/skins/0", "lacks 'joints'"},
    {R"("cameras":[{"type":"perspective","perspective":{}}])", "/cameras/0/perspective", "lacks 'yfov'"},
    {R"("extensions":{"KHR_lights_punctual":{"lights":[{}]}})", "/extensions/KHR_lights_punctual/lights/0",
     "lacks 'type'"},
    {R"("nodes":[{},{"scale":[1,1,1],"scale":[2,2,2]}])", "/nodes/1/scale", "stands twice in one object"},
};

std::string refusal_of_members(const std::string& members) {
    try {
        load_text(R"({"asset":{"version":"2.0"},)" + members + "}");
    } catch (const Error& error) {
        return error.what();
    }
    return "(was loaded)";
}

}  // namespace

TEST_CASE("what would be taken as a default in silence is refused by its JSON pointer", "[gltf]") {
    for (const Row& row : rows) {
        INFO(row.members);
        CHECK_THAT(refusal_of_members(row.members),
                   Catch::Contains(std::string("scene.gltf: ") + row.pointer + ": ") && Catch::Contains(row.reason));
    }
}
