// SPDX-License-Identifier: GPL-3.0-or-later
#include "parse_sipp/scene_stream.h"

#include <algorithm>
#include <stdexcept>
#include <type_traits>
#include <unordered_map>

#include "parse_sipp/script_shader.h"

namespace farop::sipp {
namespace {

/// Nothing but numbers; Imath's vectors are, although they do not say so.
template <class T>
constexpr bool k_is_plain =
    std::is_trivially_copyable_v<T> || std::is_same_v<T, V3d> || std::is_same_v<T, V3f>;

class Writer {
 public:
  explicit Writer(const WriteBytes& write) : write_(write) {}

  template <class T>
  void put(const T& value) {
    static_assert(k_is_plain<T>);
    write_(&value, sizeof value);
  }
  template <class T>
  void put_all(const T* data, std::size_t count) {
    static_assert(k_is_plain<T>);
    put(static_cast<std::uint64_t>(count));
    if (count > 0) write_(data, count * sizeof(T));
  }
  template <class Container>
  void put_all(const Container& values) {
    put_all(values.data(), values.size());
  }
  template <class T>
  void put_optional(const std::optional<T>& value) {
    put(value.has_value());
    if (value) put(*value);
  }

  std::uint32_t shader(const std::shared_ptr<const Shader>& shader);
  void surface(const Surface& surface);
  void scene(const Scene& scene);

 private:
  std::uint32_t number_of_surface(const std::shared_ptr<Surface>& surface);

  const WriteBytes& write_;
  std::unordered_map<const void*, std::uint32_t> shaders_, surfaces_, objects_;  // numbers from 1; 0 is none
};

enum class Tag : std::uint8_t { shader, surface, object, end };

std::uint32_t Writer::shader(const std::shared_ptr<const Shader>& shader) {
  const auto* script = dynamic_cast<const ScriptShader*>(shader.get());
  if (script == nullptr) return 0;
  if (const auto found = shaders_.find(script); found != shaders_.end()) return found->second;
  std::uint32_t inner = 0;
  if (const auto* bumpy = std::get_if<BumpySpec>(&script->spec())) inner = this->shader(bumpy->inner);
  put(Tag::shader);
  put(static_cast<std::uint32_t>(script->spec().index()));
  std::visit(
      [&](const auto& spec) {
        using Spec = std::decay_t<decltype(spec)>;
        if constexpr (std::is_same_v<Spec, BumpySpec>) {
          put(inner);
          put(spec.parameters.scale);
          put(spec.parameters.bumps);
          put(spec.parameters.holes);
        } else if constexpr (std::is_same_v<Spec, PatternSpec<BozoPattern>>) {
          put(spec.finish);
          put(spec.pattern.scale);
          put_all(spec.pattern.colors);
        } else {
          put(spec);
        }
      },
      script->spec());
  return shaders_[script] = static_cast<std::uint32_t>(shaders_.size() + 1);
}

void Writer::surface(const Surface& s) {
  const std::uint32_t shader_number = shader(s.shader);
  put(Tag::surface);
  put(shader_number);
  put_all(s.positions);
  put_all(s.normals);
  put_all(s.averaged_normals);
  put_all(s.textures);
  put(s.polygons.size());
  put_all(s.polygons.records());
}

std::uint32_t Writer::number_of_surface(const std::shared_ptr<Surface>& s) {
  if (const auto found = surfaces_.find(s.get()); found != surfaces_.end()) return found->second;
  surface(*s);
  return surfaces_[s.get()] = static_cast<std::uint32_t>(surfaces_.size() + 1);
}

void Writer::scene(const Scene& scene) {
  // Sub-objects before the objects that have them, without recursion.
  struct Step {
    const Object* object;
    std::size_t next_child = 0;
  };
  std::vector<Step> path{{&scene.root}};
  while (!path.empty()) {
    const Object& object = *path.back().object;
    if (path.back().next_child < object.children.size()) {
      const Object* child = object.children[path.back().next_child++].get();
      if (!objects_.contains(child)) path.push_back({child});
      continue;
    }
    std::vector<std::uint32_t> surfaces, children;
    for (const auto& s : object.surfaces) surfaces.push_back(number_of_surface(s));
    for (const auto& child : object.children) children.push_back(objects_.at(child.get()));
    put(Tag::object);
    put_all(object.name);
    for (int r = 0; r < 4; ++r) {
      for (int c = 0; c < 4; ++c) put(object.to_parent[r][c]);
    }
    put_all(surfaces);
    put_all(children);
    const auto number = static_cast<std::uint32_t>(objects_.size() + 1);
    objects_[&object] = number;
    path.pop_back();
  }
  put(Tag::end);
  put(static_cast<std::uint64_t>(scene.lights.size()));
  for (const Light& light : scene.lights) {
    put(light.position);
    put_optional(light.color);
    put(light.kind);
    put(light.target);
    put(light.opening_degrees);
    put(light.casts_shadows);
    put(light.shadow_size);
    put(light.active);
  }
  const ViewParameters& v = scene.view;
  for (const auto& vector : {v.from, v.at, v.up}) put_optional(vector);
  for (const auto& value : {v.angle, v.hither, v.yon}) put_optional(value);
  put_optional(v.fit);
  put_optional(v.fit_depth);
  put_optional(v.resolution);
  put_optional(v.background);
  put_optional(scene.drawing.mode);
  put_optional(scene.drawing.samples);
  put_optional(scene.drawing.two_sided);
  put(static_cast<std::uint64_t>(scene.inputs.size()));
  for (const InputSummary& in : scene.inputs) {
    put_all(in.file);
    put_all(in.format);
    for (const std::uint64_t n :
         {in.bytes, in.surfaces, in.polygons, in.patches, in.spheres, in.cones, in.lights})
      put(n);
  }
}

class Reader {
 public:
  Reader(const ReadBytes& read, std::uint64_t most_bytes) : read_(read), left_(most_bytes) {}

  template <class T>
  T get() {
    static_assert(k_is_plain<T>);
    T value;
    read_(&value, sizeof value);
    return value;
  }
  template <class Container>
  void get_all(Container& values) {
    using T = typename Container::value_type;
    static_assert(k_is_plain<T>);
    const auto count = get<std::uint64_t>();
    if (count > left_ / sizeof(T)) wrong("size");
    left_ -= count * sizeof(T);
    values.resize(count);
    if (count > 0) read_(values.data(), count * sizeof(T));
  }
  bool flag() {
    const auto byte = get<std::uint8_t>();
    if (byte > 1) wrong("flag");
    return byte != 0;
  }
  template <class Enum>
  Enum enumerator(Enum last) {
    using Number = std::underlying_type_t<Enum>;
    const auto number = get<Number>();
    if (number < 0 || number > static_cast<Number>(last)) wrong("enumerator");
    return static_cast<Enum>(number);
  }
  template <class T>
  void get_optional(std::optional<T>& value) {
    value.reset();
    if (!flag()) return;
    if constexpr (std::is_same_v<T, bool>) {
      value = flag();
    } else {
      value = get<T>();
    }
  }
  template <class Enum>
  void get_optional_enum(std::optional<Enum>& value, Enum last) {
    value.reset();
    if (flag()) value = enumerator(last);
  }

  Scene scene();

 private:
  [[noreturn]] static void wrong(const char* what) {
    throw std::runtime_error(std::string("the scene of the script arrived with a wrong ") + what);
  }
  template <class T>
  const std::shared_ptr<T>& member(const std::vector<std::shared_ptr<T>>& of, std::uint32_t number) {
    if (number == 0 || number > of.size()) wrong("number");
    return of[number - 1];
  }
  void shader();
  void surface();
  void object();
  template <class Pattern>
  void pattern_shader() {
    const auto spec = get<PatternSpec<Pattern>>();
    shaders_.push_back(std::make_shared<PatternShader<Pattern>>(spec.finish, spec.pattern));
  }

  const ReadBytes& read_;
  std::uint64_t left_;
  std::vector<std::shared_ptr<const Shader>> shaders_;
  std::vector<std::shared_ptr<Surface>> surfaces_;
  std::vector<std::shared_ptr<Object>> objects_;
};

void Reader::shader() {
  switch (get<std::uint32_t>()) {
    case 0:
      shaders_.push_back(std::make_shared<BasicShader>(get<BasicParameters>()));
      return;
    case 1:
      shaders_.push_back(std::make_shared<PhongShader>(get<PhongParameters>()));
      return;
    case 2:
      shaders_.push_back(std::make_shared<StraussShader>(get<StraussParameters>()));
      return;
    case 3:
      return pattern_shader<WoodPattern>();
    case 4:
      return pattern_shader<MarblePattern>();
    case 5:
      return pattern_shader<GranitePattern>();
    case 6: {
      const auto finish = get<PatternFinish>();
      BozoPattern pattern;
      pattern.scale = get<double>();
      get_all(pattern.colors);
      shaders_.push_back(std::make_shared<BozoShader>(finish, std::move(pattern)));
      return;
    }
    case 7:
      return pattern_shader<PlanetPattern>();
    case 8: {
      const auto inner = member(shaders_, get<std::uint32_t>());
      BumpParameters parameters;
      parameters.scale = get<double>();
      parameters.bumps = flag();
      parameters.holes = flag();
      shaders_.push_back(std::make_shared<BumpyShader>(inner, parameters));
      return;
    }
    default:
      wrong("shader");
  }
}

void Reader::surface() {
  auto s = std::make_shared<Surface>();
  s->normal_rule = NormalRule::sipp;
  if (const auto number = get<std::uint32_t>(); number != 0) {
    s->shader = member(shaders_, number);
    s->material = s->shader->approximate();
  }
  get_all(s->positions);
  get_all(s->normals);
  get_all(s->averaged_normals);
  get_all(s->textures);
  if (s->shader == nullptr || !s->shader->wants_texture()) s->textures = {};
  const std::size_t vertices = s->positions.size();
  for (const std::size_t size : {s->normals.size(), s->averaged_normals.size(), s->textures.size()}) {
    if (size != 0 && size != vertices) wrong("number of vertices");
  }
  const auto polygons = get<std::uint64_t>();
  std::vector<std::uint32_t> records;
  get_all(records);
  std::uint64_t seen = 0;
  for (std::size_t at = 0; at < records.size(); ++seen) {
    const PolygonView polygon = *PolygonList::Iterator(&records[at]);
    if (polygon.corners.size() < 3 || polygon.corners.size() >= records.size() - at ||
        (polygon.has_given_normals && s->normals.empty())) {
      wrong("polygon");
    }
    for (const std::uint32_t corner : polygon.corners) {
      if (corner >= vertices) wrong("corner");
    }
    at += 1 + polygon.corners.size();
  }
  if (seen != polygons) wrong("number of polygons");
  s->polygons = PolygonList(std::move(records), polygons);
  surfaces_.push_back(std::move(s));
}

void Reader::object() {
  auto o = std::make_shared<Object>();
  get_all(o->name);
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) o->to_parent[r][c] = get<double>();
  }
  std::vector<std::uint32_t> surfaces, children;
  get_all(surfaces);
  get_all(children);
  for (const std::uint32_t n : surfaces) o->surfaces.push_back(member(surfaces_, n));
  for (const std::uint32_t n : children) o->children.push_back(member(objects_, n));
  objects_.push_back(std::move(o));
}

Scene Reader::scene() {
  for (;;) {
    const auto tag = get<std::uint8_t>();
    if (tag == static_cast<std::uint8_t>(Tag::end)) break;
    if (tag == static_cast<std::uint8_t>(Tag::shader)) {
      shader();
    } else if (tag == static_cast<std::uint8_t>(Tag::surface)) {
      surface();
    } else if (tag == static_cast<std::uint8_t>(Tag::object)) {
      object();
    } else {
      wrong("part");
    }
  }
  if (objects_.empty()) wrong("number of objects");
  Scene scene;
  scene.root = std::move(*objects_.back());
  for (auto lights = get<std::uint64_t>(); lights > 0; --lights) {
    Light light;
    light.position = get<V3d>();
    get_optional(light.color);
    light.kind = enumerator(LightKind::spot_soft);
    light.target = get<V3d>();
    light.opening_degrees = get<double>();
    light.casts_shadows = flag();
    light.shadow_size = get<int>();
    light.active = flag();
    scene.lights.push_back(light);
  }
  ViewParameters& v = scene.view;
  for (auto* vector : {&v.from, &v.at, &v.up}) get_optional(*vector);
  for (auto* value : {&v.angle, &v.hither, &v.yon}) get_optional(*value);
  get_optional_enum(v.fit, Fit::both);
  get_optional(v.fit_depth);
  get_optional(v.resolution);
  get_optional(v.background);
  get_optional_enum(scene.drawing.mode, DrawMode::phong);
  get_optional(scene.drawing.samples);
  get_optional(scene.drawing.two_sided);
  for (auto inputs = get<std::uint64_t>(); inputs > 0; --inputs) {
    InputSummary in;
    get_all(in.file);
    get_all(in.format);
    for (std::uint64_t* n :
         {&in.bytes, &in.surfaces, &in.polygons, &in.patches, &in.spheres, &in.cones, &in.lights})
      *n = get<std::uint64_t>();
    scene.inputs.push_back(std::move(in));
  }
  return scene;
}

}  // namespace

void write_scene(const Scene& scene, const WriteBytes& write) {
  Writer(write).scene(scene);
}

Scene read_scene(const ReadBytes& read, std::uint64_t most_bytes) {
  return Reader(read, most_bytes).scene();
}

}  // namespace farop::sipp
