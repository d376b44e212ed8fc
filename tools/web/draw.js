// Draws plants, balls and ground by WebGL2. In: surfaces in the library's memory. Out: pixels.
"use strict";

const VERTEX = `#version 300 es
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 vertex_color;
uniform mat4 camera;
uniform vec4 place;  // of a ball: position and radius; else radius 0
out vec3 at, up, tint;
out vec2 st;
void main() {
    tint = pow(vertex_color.rgb, vec3(2.2));
    at = place.w > 0.0 ? place.xyz + place.w * position : position;
    up = normal;
    st = uv;
    gl_Position = camera * vec4(at, 1.0);
}`;
const FRAGMENT = `#version 300 es
precision highp float;
in vec3 at, up, tint;
in vec2 st;
uniform vec4 color;
uniform bool textured;
uniform sampler2D image;
uniform vec3 eye;
out vec4 pixel;
void main() {
    vec4 base = color * vec4(tint, 1.0);
    if (textured) {
        vec4 texel = texture(image, st);
        if (texel.a < 0.5) discard;
        base *= vec4(pow(texel.rgb, vec3(2.2)), 1.0);
    }
    vec3 sun = normalize(vec3(0.4, 0.9, 0.3)), n = normalize(up);
    if (dot(n, eye - at) < 0.0) n = -n;
    float through = 0.25 * max(-dot(n, sun), 0.0);
    vec3 light = vec3(1.5, 1.4, 1.2) * (max(dot(n, sun), 0.0) + through) + mix(vec3(0.25, 0.22, 0.18), vec3(0.45, 0.55, 0.7), 0.5 + 0.5 * n.y);
    float far = smoothstep(8.0, 30.0, length(at - eye));
    vec3 seen = mix(base.rgb * light, vec3(0.72, 0.78, 0.82), far);
    pixel = vec4(pow(seen, vec3(1.0 / 2.2)), 1.0);
}`;

class Drawing {
    constructor(canvas) {
        this.canvas = canvas;
        this.gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
        if (!this.gl) throw new Error("this browser has no WebGL2");
        const gl = this.gl, program = this.program = gl.createProgram();
        for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
            const shader = gl.createShader(kind);
            gl.shaderSource(shader, text);
            gl.compileShader(shader);
            if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
            gl.attachShader(program, shader);
        }
        gl.linkProgram(program);
        gl.useProgram(program);
        this.at = name => gl.getUniformLocation(program, name);
        gl.enable(gl.DEPTH_TEST);
        gl.clearColor(0.87, 0.90, 0.92, 1);
        this.plants = [];
        this.ball = this.makeMesh(...Drawing.ballMesh(), gl.STATIC_DRAW);
        const far = 40;
        this.ground = this.makeMesh(new Float32Array([-far, 0, -far, far, 0, -far, far, 0, far, -far, 0, far]),
            new Float32Array([0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0]), null, new Uint32Array([0, 1, 2, 0, 2, 3]), gl.STATIC_DRAW);
    }
    static ballMesh() {
        const rows = 12, columns = 18, positions = [], indices = [];
        for (let i = 0; i <= rows; i++)
            for (let k = 0; k <= columns; k++) {
                const a = Math.PI * i / rows, b = 2 * Math.PI * k / columns;
                positions.push(Math.sin(a) * Math.cos(b), Math.cos(a), Math.sin(a) * Math.sin(b));
                if (i < rows && k < columns) {
                    const p = i * (columns + 1) + k;
                    indices.push(p, p + 1, p + columns + 1, p + 1, p + columns + 2, p + columns + 1);
                }
            }
        const points = new Float32Array(positions);
        return [points, points, null, new Uint32Array(indices)];
    }
    makeMesh(positions, normals, uvs, indices, usage, colors = null) {
        const gl = this.gl, mesh = { vertices: gl.createVertexArray(), count: indices.length };
        gl.bindVertexArray(mesh.vertices);
        const attribute = (place, size, data, use) => {
            const buffer = gl.createBuffer();
            gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
            gl.bufferData(gl.ARRAY_BUFFER, data, use);
            gl.enableVertexAttribArray(place);
            gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
            return buffer;
        };
        mesh.positions = attribute(0, 3, positions, usage);
        mesh.normals = attribute(1, 3, normals, usage);
        if (uvs) mesh.uvs = attribute(2, 2, uvs, gl.STATIC_DRAW);
        gl.vertexAttrib4f(3, 1, 1, 1, 1);
        if (colors) {
            mesh.colors = gl.createBuffer();
            gl.bindBuffer(gl.ARRAY_BUFFER, mesh.colors);
            gl.bufferData(gl.ARRAY_BUFFER, colors, gl.STATIC_DRAW);
            gl.enableVertexAttribArray(3);
            gl.vertexAttribPointer(3, 4, gl.UNSIGNED_BYTE, true, 0, 0);
        }
        mesh.indices = gl.createBuffer();
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, mesh.indices);
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
        return mesh;
    }
    setPlants(surfaces, parts, textures) {
        const gl = this.gl;
        for (const mesh of this.plants) {
            for (const buffer of [mesh.positions, mesh.normals, mesh.uvs, mesh.colors, mesh.indices]) if (buffer) gl.deleteBuffer(buffer);
            gl.deleteVertexArray(mesh.vertices);
        }
        this.parts = parts;
        this.textures = textures;
        this.plants = surfaces.map(s => this.makeMesh(s.positions, s.normals, s.uvs, s.indices, gl.DYNAMIC_DRAW, s.colors));
    }
    makeTexture(image) {
        const gl = this.gl, texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, image);
        gl.generateMipmap(gl.TEXTURE_2D);
        return texture;
    }
    movePlant(i, positions, normals) {
        const gl = this.gl;
        gl.bindBuffer(gl.ARRAY_BUFFER, this.plants[i].positions);
        gl.bufferSubData(gl.ARRAY_BUFFER, 0, positions);
        gl.bindBuffer(gl.ARRAY_BUFFER, this.plants[i].normals);
        gl.bufferSubData(gl.ARRAY_BUFFER, 0, normals);
    }
    draw(camera, eye, balls) {
        const gl = this.gl, canvas = this.canvas;
        const width = Math.round(canvas.clientWidth * devicePixelRatio), height = Math.round(canvas.clientHeight * devicePixelRatio);
        if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
        gl.viewport(0, 0, width, height);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        gl.uniformMatrix4fv(this.at("camera"), false, camera);
        gl.uniform3fv(this.at("eye"), eye);
        const mesh = (m, color, first = 0, count = m.count) => {
            gl.bindVertexArray(m.vertices);
            gl.uniform4fv(this.at("color"), color);
            gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, 4 * first);
        };
        gl.uniform1i(this.at("textured"), 0);
        gl.uniform4f(this.at("place"), 0, 0, 0, 0);
        mesh(this.ground, [0.30, 0.25, 0.18, 1]);
        for (const [x, y, z, radius] of balls) {
            gl.uniform4f(this.at("place"), x, y, z, radius);
            mesh(this.ball, [0.55, 0.16, 0.07, 1]);
        }
        gl.uniform4f(this.at("place"), 0, 0, 0, 0);
        for (const part of this.parts || []) {
            const texture = this.textures[part.texture];
            gl.uniform1i(this.at("textured"), texture ? 1 : 0);
            if (texture) gl.bindTexture(gl.TEXTURE_2D, texture);
            for (const plant of this.plants) mesh(plant, part.color, 3 * part.first, 3 * part.count);
        }
    }
}
