#pragma once

namespace capstan::python {

/// Makes base::InputError the Python exception capstan.InputError, and std::filesystem::filesystem_error too.
/// Options have their Python names in it: `--read-as` is `read_as`.
void translateErrors();

}  // namespace capstan::python
