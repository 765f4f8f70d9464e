// SPDX-License-Identifier: GPL-3.0-or-later
// A rasterizer written in Python: embeds the interpreter and forwards the five calls to a class Rasterizer.
//
// The host hands over the file as two options: `script` its name, for messages, and `source` its text, so
// that nothing needs to be opened where files are out of reach. One interpreter serves all scripts of a
// process; every host is a script.
#define PY_SSIZE_T_CLEAN
#include <Python.h>
#include <dlfcn.h>
#include <farop/rasterizer.h>

#include <cctype>
#include <string>
#include <vector>

#include "adapter_source.h"

namespace {

/// A user's file.
struct Script {
  const farop_host* host = nullptr;
  PyObject* rasterizer = nullptr;  ///< its class
  std::string file, name, summary;
  farop_rasterizer table{};
};
/// What `self` points to.
struct Instance {
  const Script* script;
  PyObject* object;
};

PyObject* g_adapter = nullptr;  ///< names of adapter.py
std::vector<Script*> g_scripts;
const Script* g_current = nullptr;  ///< whose call is running

/// A reference that is given up at the end of its scope.
class Owned {
 public:
  explicit Owned(PyObject* object) : object_(object) {}
  ~Owned() { Py_XDECREF(object_); }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  PyObject* get() const { return object_; }
  explicit operator bool() const { return object_ != nullptr; }

 private:
  PyObject* object_;
};

PyObject* adapter(const char* name) {
  return PyDict_GetItemString(g_adapter, name);  // borrowed
}

/// The last line of a text that is not empty.
std::string last_line(const std::string& text) {
  const std::size_t last = text.find_last_not_of(" \t\r\n");
  if (last == std::string::npos) return {};
  const std::size_t before = text.find_last_of('\n', last);
  const std::size_t first = before == std::string::npos ? 0 : before + 1;
  return text.substr(first, last + 1 - first);
}

/// Logs the pending exception; the status it means.
farop_status failure() {
  PyObject *type = nullptr, *value = nullptr, *trace = nullptr;
  PyErr_Fetch(&type, &value, &trace);
  PyErr_NormalizeException(&type, &value, &trace);
  if (value != nullptr && trace != nullptr) PyException_SetTraceback(value, trace);
  const bool memory = PyErr_GivenExceptionMatches(type, PyExc_MemoryError) != 0;
  PyObject* const report = g_adapter == nullptr ? nullptr : adapter("report");
  if (report != nullptr) {
    const Owned done(PyObject_CallFunction(report, "Os", value, g_current->file.c_str()));
    if (!done) PyErr_Clear();
  } else {
    const Owned text(value == nullptr ? nullptr : PyObject_Str(value));
    const char* const whole = text ? PyUnicode_AsUTF8(text.get()) : nullptr;
    const std::string line = whole == nullptr ? std::string() : last_line(whole);
    const char* const words = line.empty() ? nullptr : line.c_str();
    g_current->host->log(g_current->host, FAROP_LOG_ERROR,
                         words == nullptr ? "python: unknown failure" : words);
    PyErr_Clear();
  }
  Py_XDECREF(type), Py_XDECREF(value), Py_XDECREF(trace);
  return memory ? FAROP_E_MEMORY : FAROP_E_INTERNAL;
}

/// None and True mean done, a number is a status.
farop_status status_of(const Owned& result) {
  if (!result) return failure();
  if (!PyLong_Check(result.get()) || PyBool_Check(result.get())) return FAROP_OK;
  const long status = PyLong_AsLong(result.get());
  if (status == -1 && PyErr_Occurred() != nullptr) return failure();
  return static_cast<farop_status>(status);
}

/// A view of the host's memory; None for NULL.
PyObject* view(const void* memory, std::size_t bytes, int access) {
  if (memory == nullptr) Py_RETURN_NONE;
  return PyMemoryView_FromMemory(static_cast<char*>(const_cast<void*>(memory)),
                                 static_cast<Py_ssize_t>(bytes), access);
}

// ---- module farop_host
// ------------------------------------------------------------------------------------------

PyObject* host_log(PyObject*, PyObject* arguments) {
  int level = 0;
  const char* text = nullptr;
  if (PyArg_ParseTuple(arguments, "is", &level, &text) == 0) return nullptr;
  g_current->host->log(g_current->host, level, text);
  Py_RETURN_NONE;
}

PyObject* host_option(PyObject*, PyObject* arguments) {
  const char* key = nullptr;
  if (PyArg_ParseTuple(arguments, "s", &key) == 0) return nullptr;
  const char* const value = g_current->host->option(g_current->host, key);
  if (value == nullptr) Py_RETURN_NONE;
  return PyUnicode_FromString(value);
}

PyMethodDef g_methods[] = {{"log", host_log, METH_VARARGS, nullptr},
                           {"option", host_option, METH_VARARGS, nullptr},
                           {nullptr, nullptr, 0, nullptr}};
PyModuleDef g_module{
    PyModuleDef_HEAD_INIT, "farop_host", nullptr, -1, g_methods, nullptr, nullptr, nullptr, nullptr};

PyObject* make_host_module() {
  return PyModule_Create(&g_module);
}

// ---- the table
// --------------------------------------------------------------------------------------------------

PyObject* enter(void* self) {
  const Instance& instance = *static_cast<Instance*>(self);
  g_current = instance.script;
  return instance.object;
}

farop_status create(const farop_host* host, void** self) {
  for (const Script* script : g_scripts) {
    if (script->host == host) g_current = script;
  }
  PyObject* const object = PyObject_CallFunction(adapter("create"), "O", g_current->rasterizer);
  if (object == nullptr) return failure();
  *self = new Instance{g_current, object};
  return FAROP_OK;
}

void destroy(void* self) {
  const Owned object(enter(self));
  const Owned done(PyObject_CallFunction(adapter("destroy"), "O", object.get()));
  if (!done) failure();
  delete static_cast<Instance*>(self);
}

farop_status begin_frame(void* self, const farop_frame* f) {
  PyObject* const object = enter(self);
  const std::size_t bytes = static_cast<std::size_t>(f->row_bytes) * static_cast<std::size_t>(f->height - 1) +
                            3 * static_cast<std::size_t>(f->width);
  const Owned memory(view(f->pixels, bytes, PyBUF_WRITE));
  const Owned arguments(Py_BuildValue("(OOLy#)", object, memory.get(), static_cast<long long>(f->row_bytes),
                                      reinterpret_cast<const char*>(f->background), Py_ssize_t{3}));
  const Owned numbers(Py_BuildValue("{sisisisisisIsI}", "width", f->width, "height", f->height,
                                    "subpixel_bits", f->subpixel_bits, "z_near", f->z_near, "z_far", f->z_far,
                                    "max_vertices", f->max_vertices, "number", f->number));
  if (!memory || !arguments || !numbers) return failure();
  return status_of(Owned(PyObject_Call(adapter("begin_frame"), arguments.get(), numbers.get())));
}

farop_status polygon(void* self, const farop_polygon* p) {
  PyObject* const object = enter(self);
  const std::size_t n = p->vertex_count;
  const Owned vertices(view(p->vertices, n * sizeof(farop_vertex), PyBUF_READ));
  const Owned normals(view(p->normals, n * sizeof(farop_vec3), PyBUF_READ));
  const Owned eye_positions(view(p->eye_positions, n * sizeof(farop_vec3), PyBUF_READ));
  const Owned ids(view(p->vertex_ids, n * sizeof(std::uint32_t), PyBUF_READ));
  const farop_material* const m = p->material;
  const auto d = [](float v) { return static_cast<double>(v); };
  const Owned material(m == nullptr ? Py_BuildValue("")
                                    : Py_BuildValue("(I(dddddddddd))", m->id, d(m->color[0]), d(m->color[1]),
                                                    d(m->color[2]), d(m->ambient), d(m->diffuse),
                                                    d(m->specular), d(m->shininess), d(m->opacity[0]),
                                                    d(m->opacity[1]), d(m->opacity[2])));
  if (!vertices || !normals || !eye_positions || !ids || !material) return failure();
  return status_of(Owned(PyObject_CallFunction(adapter("polygon"), "OOOOOOIIII", object, vertices.get(),
                                               normals.get(), eye_positions.get(), ids.get(), material.get(),
                                               p->index, p->flags, p->surface_id, p->object_id)));
}

farop_status end_frame(void* self) {
  return status_of(Owned(PyObject_CallFunction(adapter("end_frame"), "O", enter(self))));
}

/// A name that the interface allows, from "folder/My file.py".
std::string name_from(const std::string& script) {
  const std::size_t slash = script.find_last_of('/');
  std::string name;
  for (const char c : script.substr(slash == std::string::npos ? 0 : slash + 1)) {
    if (c == '.') break;
    const auto u = static_cast<unsigned char>(c);
    name += std::isalnum(u) != 0 ? static_cast<char>(std::tolower(u)) : '_';
  }
  return name.empty() ? "python" : name;
}

/// The interpreter's own prefix, from where its library lies; what python3 the PATH has does not matter. Its
/// symbols must be seen by extension modules like NumPy's, although this library is loaded for itself alone.
std::wstring python_home() {
  Dl_info info{};
  if (::dladdr(reinterpret_cast<const void*>(&Py_InitializeFromConfig), &info) == 0) return {};
  ::dlopen(info.dli_fname, RTLD_NOW | RTLD_GLOBAL | RTLD_NOLOAD);
  const std::string path = info.dli_fname;
  const std::size_t lib = path.find("/lib/");
  return lib == std::string::npos ? std::wstring()
                                  : std::wstring(path.begin(), path.begin() + static_cast<long>(lib));
}

bool start_interpreter() {
  if (PyImport_AppendInittab("farop_host", make_host_module) != 0) return false;
  PyConfig config;
  PyConfig_InitIsolatedConfig(&config);  // no environment variables, no signal handlers
  config.write_bytecode = 0;
  const std::wstring home = python_home();
  PyStatus status = home.empty() ? PyStatus_Ok() : PyConfig_SetString(&config, &config.home, home.c_str());
  if (PyStatus_Exception(status) == 0) status = Py_InitializeFromConfig(&config);
  PyConfig_Clear(&config);
  if (PyStatus_Exception(status) != 0) {
    g_current->host->log(g_current->host, FAROP_LOG_ERROR,
                         status.err_msg == nullptr ? "python does not start" : status.err_msg);
    return false;
  }
  PyObject* const names = PyDict_New();
  if (names == nullptr) return false;
  PyDict_SetItemString(names, "__builtins__", PyEval_GetBuiltins());
  const Owned code(Py_CompileString(k_adapter_source, "adapter.py", Py_file_input));
  const Owned ran(code ? PyEval_EvalCode(code.get(), names, names) : nullptr);
  if (ran) g_adapter = names;  // else without report(), which may not be there
  return static_cast<bool>(ran);
}

bool load(Script& script, const char* source) {
  const Owned loaded(PyObject_CallFunction(adapter("load"), "ss", source, script.file.c_str()));
  unsigned wants = 0;
  const char* summary = nullptr;
  if (!loaded || PyArg_ParseTuple(loaded.get(), "OIs", &script.rasterizer, &wants, &summary) == 0)
    return false;
  Py_INCREF(script.rasterizer);
  script.summary = *summary == 0 ? "a rasterizer in Python" : summary;
  script.name = name_from(script.file);
  script.table = {sizeof(farop_rasterizer),
                  FAROP_ABI_VERSION,
                  script.name.c_str(),
                  script.summary.c_str(),
                  wants,
                  0,
                  create,
                  destroy,
                  begin_frame,
                  polygon,
                  end_frame};
  return true;
}

}  // namespace

const farop_rasterizer* farop_rasterizer_entry(const farop_host* host) {
  const char* const file = host->option(host, "script");
  const char* const source = host->option(host, "source");
  if (file == nullptr || source == nullptr) {
    host->log(host, FAROP_LOG_ERROR, "python: it needs a script: --rasterizer FILE.py");
    return nullptr;
  }
  Script* const script = new Script;  // lives as long as the process, like its table
  script->host = host;
  script->file = file;
  g_scripts.push_back(script);
  g_current = script;
  if ((g_adapter == nullptr && !start_interpreter()) || !load(*script, source)) {
    if (Py_IsInitialized() != 0 && PyErr_Occurred() != nullptr) failure();
    return nullptr;
  }
  return &script->table;
}
