# docker build -t eyeray . && docker run --rm -v "$PWD:/scenes" -w /scenes eyeray SCENES
# verifies scenes on lavapipe (scripts/verify-in-ci). For another command: --entrypoint eyeray.
FROM debian:12-slim
COPY . /eyeray
RUN /eyeray/scripts/setup && /eyeray/scripts/build release eyeray \
  && ln -s /eyeray/build/release/eyeray /usr/local/bin/eyeray \
  && rm -rf /var/lib/apt/lists/*
ENV EYERAY_BINARY=/eyeray/build/release/eyeray
ENTRYPOINT ["/eyeray/scripts/verify-in-ci"]
