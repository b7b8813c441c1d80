#include "errors.h"

#include "trivalent/dual/error.h"
#include "trivalent/potentials/error.h"
#include "trivalent/remesh/error.h"

namespace trivalent::python {
namespace {

namespace py = pybind11;

void raise(const char* name, const std::exception& error) {
  const py::object type = py::module_::import("trivalent._errors").attr(name);
  PyErr_SetString(type.ptr(), error.what());
}

void translate(const std::exception_ptr& pointer) {
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const InvalidArray& error) {
    raise("InvalidArray", error);
  } catch (const WrongOption& error) {
    raise("InvalidOption", error);
  } catch (const remesh::Stopped& error) {
    PyErr_SetString(PyExc_KeyboardInterrupt, error.what());
  } catch (const remesh::InvalidOption& error) {
    raise("InvalidOption", error);
  } catch (const dual::InvalidOption& error) {
    raise("InvalidOption", error);
  } catch (const potentials::InvalidOption& error) {
    raise("InvalidOption", error);
  } catch (const remesh::InvalidMesh& error) {
    raise("InvalidMesh", error);
  } catch (const remesh::FileError& error) {
    raise("FileError", error);
  } catch (const dual::InvalidNetwork& error) {
    raise("InvalidNetwork", error);
  } catch (const potentials::InvalidAtoms& error) {
    raise("InvalidAtoms", error);
  } catch (const remesh::Error& error) {
    raise("Error", error);
  } catch (const dual::Error& error) {
    raise("Error", error);
  } catch (const potentials::Error& error) {
    raise("Error", error);
  }
}

}  // namespace

void translate_errors() {
  // pybind11 hands it over by value. NOLINTNEXTLINE(performance-unnecessary-value-param)
  py::register_exception_translator([](std::exception_ptr pointer) { translate(pointer); });
}

}  // namespace trivalent::python
