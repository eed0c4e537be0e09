# SPDX-License-Identifier: Apache-2.0
"""What pip calls (pyproject.toml): setuptools, with the setup.py that lies next to this file."""

from setuptools import build_meta


class Backend(build_meta._BuildMetaBackend):
    def run_setup(self, setup_script="adapters/python/setup.py"):
        super().run_setup(setup_script)


backend = Backend()
build_wheel = backend.build_wheel
get_requires_for_build_wheel = backend.get_requires_for_build_wheel
prepare_metadata_for_build_wheel = backend.prepare_metadata_for_build_wheel
